// SPDX-License-Identifier: MIT
// A surface in 32 bytes between surface.frag and the passes that light it: base colour and two normals in integers,
// lightmap coordinates as they are, and two numbers of two each: metallic and transmission, roughness and F0.

struct PackedSurface {
    vec3 position;
    vec3 geometricNormal; // unit, to the viewer
    vec3 detailNormal;    // unit, the shading normal
    vec3 toEye;           // unit
    vec3 baseColor;
    float metallic, roughness;
    vec2 lightmapUv; // without a lightmap: the instance's number and 0
    vec3 albedo; // diffuse reflectance
    vec3 F0;     // reflectance at normal incidence
    float transmission, dielectricF0; // of what is not metal: share that passes, reflectance at normal incidence
    float nearReach; // m; within it, light of near surfaces replaces the field's. 0: nowhere
};

// Cigolle et al. A Survey of Efficient Representations for Independent Unit Vectors. 2014
vec2 octEncode(vec3 n) {
    const vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    const vec2 s = vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * s;
}

vec3 octDecode(vec2 p) {
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    const float t = max(-n.z, 0.0);
    n.xy -= vec2(n.x >= 0.0 ? t : -t, n.y >= 0.0 ? t : -t);
    return normalize(n);
}

// A number from 2^-32 to 2^32 within 0.04 %, or 0, as a fraction in [0, 1].
float packScale(float x) {
    return x > 0.0 ? (clamp(log2(x), -31.9, 32.0) + 32.0) / 64.0 : 0.0;
}

float unpackScale(float x) {
    return x > 0.0 ? exp2(64.0 * x - 32.0) : 0.0;
}

// Metallic and transmission in one number, the latter in 255 steps; metallic alone where nothing is transmitted.
float packMetallic(float metallic, float transmission) {
    return clamp(metallic, 0.0, 1.0) + 2.0 * round(255.0 * transmission);
}

// Roughness and a dielectric's F0 in one number: its square root in 1022 steps; roughness alone for F0 = 0.04.
float packRoughness(float roughness, float dielectricF0) {
    const float step = abs(dielectricF0 - 0.04) < 1e-6 ? 0.0 : 1.0 + round(1022.0 * sqrt(dielectricF0));
    return clamp(roughness, 0.0, 1.0) + 2.0 * step;
}

// Stores square roots of the base colour: their 16 bits keep dark colours down to 2e-4 within 1e-3 of themselves.
uvec4 packSurface(vec3 baseColor, vec3 normal, vec3 geometricNormal, float nearReach) {
    const vec3 root = sqrt(clamp(baseColor, 0.0, 1.0));
    return uvec4(packUnorm2x16(root.rg), packUnorm2x16(vec2(root.b, packScale(nearReach))), packSnorm2x16(octEncode(normal)),
                 packSnorm2x16(octEncode(geometricNormal)));
}

PackedSurface unpackSurface(uvec4 p, vec4 receiver) {
    PackedSurface s;
    const vec2 more = unpackUnorm2x16(p.y);
    const vec3 root = vec3(unpackUnorm2x16(p.x), more.x);
    s.nearReach = unpackScale(more.y);
    s.baseColor = root * root;
    s.lightmapUv = receiver.xy;
    const vec2 steps = floor(0.5 * receiver.zw);
    s.metallic = receiver.z - 2.0 * steps.x;
    s.roughness = receiver.w - 2.0 * steps.y;
    s.transmission = steps.x / 255.0;
    s.albedo = min(s.baseColor * (1.0 - s.metallic) * (1.0 - s.transmission), 0.99);
    const float F0 = (steps.y - 1.0) / 1022.0;
    s.dielectricF0 = steps.y > 0.0 ? F0 * F0 : 0.04;
    s.F0 = mix(vec3(s.dielectricF0), s.baseColor, s.metallic);
    s.detailNormal = octDecode(unpackSnorm2x16(p.z));
    s.geometricNormal = octDecode(unpackSnorm2x16(p.w));
    return s;
}
