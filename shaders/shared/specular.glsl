// SPDX-License-Identifier: MIT
// Glossy reflection of light in spherical harmonics: engine/scene/surface/reflection_lobe.h, whose table this reads.

const float kPi = 3.14159265358979;

/// ReflectionLobe of engine/scene/surface/reflection_lobe.h; only the factors of the bands in use are read.
struct ReflectionLobe {
    vec2 share, towards;
    float factors[8];
};

ReflectionLobe reflectionLobe(sampler2DArray table, float roughness, float NoV, int bands) {
    const float nodes = float(textureSize(table, 0).x);
    const vec2 at = (vec2(sqrt(NoV), roughness) * (nodes - 1.0) + 0.5) / nodes;
    const vec4 a = textureLod(table, vec3(at, 0), 0.0);
    const float s1 = sqrt(dot(a.zw, a.zw) + 2.0 * a.z * a.w * NoV);
    const vec4 b = bands > 2 ? textureLod(table, vec3(at, 1), 0.0) : vec4(0);
    const vec4 c = bands > 6 ? textureLod(table, vec3(at, 2), 0.0) : vec4(0);
    return ReflectionLobe(a.xy, a.zw, float[](1.0, s1, b.x, b.y, b.z, b.w, c.x, c.y));
}
