// SPDX-License-Identifier: MIT
// VIEW_LIT and VIEW_DIRECT: everything but direct light, and the surface for direct.frag.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/surface.glsl"
#include "shaders/shared/surface_pack.glsl"

layout(location = 0) out vec4 outColor;
layout(location = 1) out uvec4 outSurface;

// Emission and what bounced light makes of the surface.
vec3 indirectRadiance(Surface s) {
    vec3 c[kCoefficients];
    if (!readIndirect(s, c))
        return emission();
    const vec3 F0 = mix(vec3(0.04), s.baseColor, s.metallic);
    const float NoV = clamp(dot(s.detailNormal, s.toEye), 0.0, 1.0);
    const vec3 specular = specularAlbedo(F0, s.roughness, NoV) *
                          shLobe(c, reflect(-s.toEye, s.detailNormal), lobeExponent(s.roughness));
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
