// SPDX-License-Identifier: MIT
// VIEW_LIT and VIEW_DIRECT: everything but direct light, and the surface for direct.frag.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/surface.glsl"
#include "shaders/shared/surface_pack.glsl"

layout(location = 0) out vec4 outColor;
layout(location = 1) out uvec4 outSurface;

// Directional albedo of the specular lobe. Karis. Physically Based Shading on Mobile. 2014.
vec3 specularAlbedo(vec3 F0, float roughness, float NoV) {
    const vec4 r = roughness * vec4(-1, -0.0275, -0.572, 0.022) + vec4(1, 0.0425, 1.04, -0.04);
    const float a = min(r.x * r.x, exp2(-9.28 * NoV)) * r.x + r.y;
    return max(F0 * (-1.04 * a + r.z) + (1.04 * a + r.w), 0.0);
}

// Emission and what bounced light makes of the surface.
vec3 indirectRadiance(Surface s) {
    vec3 c[9];
    if (!readIndirect(s, c))
        return emission();
    const vec3 F0 = mix(vec3(0.04), s.baseColor, s.metallic);
    const float alpha = max(s.roughness * s.roughness, 0.05);
    const float NoV = clamp(dot(s.detailNormal, s.toEye), 0.0, 1.0);
    const vec3 specular = specularAlbedo(F0, s.roughness, NoV) *
                          shLobe(c, reflect(-s.toEye, s.detailNormal), 2.0 / (alpha * alpha) - 2.0);
    return s.albedo * shIrradiance(c, s.detailNormal) / kPi + specular + emission();
}

void main() {
    const Surface s = readSurface(baseColor());
    outColor = vec4(0, 0, 0, 1);
    if (isBlackBack()) { // two normals that no light meets both
        outSurface = packSurface(vec3(0), 0.0, 1.0, -s.geometricNormal, s.geometricNormal);
        return;
    }
    if (kView == VIEW_LIT)
        outColor.rgb = indirectRadiance(s);
    outSurface = packSurface(s.baseColor, s.metallic, s.roughness, s.detailNormal, s.geometricNormal);
}
