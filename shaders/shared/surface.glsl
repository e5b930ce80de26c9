// SPDX-License-Identifier: MIT
// Surface data of a rasterised fragment: inputs, material, normals. For fragment shaders used with surface.vert.
#include "shaders/shared/gpu_frame.h"
#include "shaders/shared/gpu_material.h"

layout(constant_id = 0) const uint kView = VIEW_LIT;
layout(constant_id = 1) const uint kFeatures = 0;

layout(push_constant) uniform Draw { GpuDraw draw; };

layout(set = 0, binding = FRAME_BLOCK) uniform FrameBlock { GpuFrame frame; };

layout(set = 1, binding = 0) uniform MaterialBlock { GpuMaterial material; };
layout(set = 1, binding = 1) uniform sampler2D textures0;
layout(set = 1, binding = 2) uniform sampler2D textures1;
layout(set = 1, binding = 3) uniform sampler2D textures2;
layout(set = 1, binding = 4) uniform sampler2D textures3;

layout(location = 0) in vec3 fragPosition;
layout(location = 1) in vec3 fragNormal;
layout(location = 2) in vec4 fragTangent;
layout(location = 3) in vec4 fragUv;
layout(location = 4) in vec4 fragColor;
layout(location = 5) in vec2 fragLightmapUv;

bool has(uint feature) {
    return (kFeatures & feature) != 0;
}

vec2 textureUv(int k) {
    const vec3 uv = vec3(material.uvRows[2 * k].w > 0.5 ? fragUv.zw : fragUv.xy, 1);
    return vec2(dot(material.uvRows[2 * k].xyz, uv), dot(material.uvRows[2 * k + 1].xyz, uv));
}

struct Surface {
    vec3 position;
    vec3 geometricNormal; // unit, to the viewer
    vec3 normal;          // unit, of the interpolated vertex normals, on the viewer's side
    vec3 detailNormal;    // the same with the normal map
    vec3 toEye;           // unit
    vec3 baseColor;
    float metallic, roughness;
    vec3 albedo; // diffuse reflectance
};

vec3 mappedNormal(vec3 n, float side) {
    vec3 t = fragTangent.xyz - n * dot(n, fragTangent.xyz);
    const float t2 = dot(t, t);
    if (t2 < 1e-20)
        return n;
    t *= inversesqrt(t2);
    // The map is given in the frame of the front face: that of the vertex normal before it was turned to the viewer.
    const vec3 front = side * n;
    const vec3 b = cross(front, t) * fragTangent.w;
    vec3 m = texture(textures2, textureUv(TEXTURE_NORMAL)).xyz * 2.0 - 1.0;
    m.xy *= material.normalScale;
    const vec3 mapped = side * (t * m.x + b * m.y + front * m.z);
    const float m2 = dot(mapped, mapped);
    return m2 > 1e-20 ? mapped * inversesqrt(m2) : n;
}

Surface readSurface(vec4 base) {
    Surface s;
    s.position = fragPosition;
    s.toEye = normalize(frame.eye - fragPosition);
    const vec3 g = cross(dFdx(fragPosition), dFdy(fragPosition));
    const float g2 = dot(g, g);
    const float side = gl_FrontFacing ? 1.0 : -1.0;
    const float n2 = dot(fragNormal, fragNormal);
    const vec3 n = n2 > 0.0 ? side * fragNormal * inversesqrt(n2) : s.toEye;
    s.geometricNormal = g2 > 0.0 ? g * inversesqrt(g2) : n;
    if (dot(s.geometricNormal, s.toEye) < 0.0)
        s.geometricNormal = -s.geometricNormal;
    s.normal = dot(n, s.geometricNormal) > 0.0 ? n : s.geometricNormal;
    s.detailNormal = s.normal;
    if (has(FEATURE_NORMAL_TEXTURE) && kView != VIEW_ALBEDO)
        s.detailNormal = mappedNormal(s.normal, side);
    s.baseColor = base.rgb;
    s.metallic = material.metallic;
    s.roughness = material.roughness;
    if (has(FEATURE_METALLIC_ROUGHNESS_TEXTURE)) {
        const vec4 t = texture(textures1, textureUv(TEXTURE_METALLIC_ROUGHNESS));
        s.roughness *= t.g;
        s.metallic *= t.b;
    }
    s.albedo = min(s.baseColor * (1.0 - s.metallic) * (1.0 - material.transmission), 0.99);
    return s;
}

vec3 emission() {
    vec3 e = material.emission;
    if (has(FEATURE_EMISSIVE_TEXTURE))
        e *= texture(textures3, textureUv(TEXTURE_EMISSIVE)).rgb;
    return e;
}

// Discards what the alpha mask removes. Alpha is that of the finest level, as rays read it: in coarser levels it tends
// to its mean, and surfaces whose coverage is below the cutoff would vanish.
vec4 baseColor() {
    const vec4 factor = material.baseColor * fragColor;
    vec4 base = factor;
    if (has(FEATURE_BASE_COLOR_TEXTURE)) {
        const vec2 uv = textureUv(TEXTURE_BASE_COLOR);
        base *= texture(textures0, uv);
        if (has(FEATURE_ALPHA_MASK))
            base.a = factor.a * textureLod(textures0, uv, 0.0).a;
    }
    if (has(FEATURE_ALPHA_MASK) && base.a < material.alphaCutoff)
        discard;
    return base;
}

bool isBlackBack() {
    return !gl_FrontFacing && (draw.flags & DRAW_DOUBLE_SIDED) == 0;
}
