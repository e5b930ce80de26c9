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
    const FieldSums field =
        readIndirect(s, reflect(-s.toEye, s.detailNormal), lobeExponent(s.roughness));
    const vec3 F0 = mix(vec3(0.04), s.baseColor, s.metallic);
    const float NoV = clamp(dot(s.detailNormal, s.toEye), 0.0, 1.0);
    return s.albedo * field.irradiance / kPi + specularAlbedo(F0, s.roughness, NoV) * field.lobe + emission();
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
