// SPDX-License-Identifier: MIT
// All that shading needs of a surface besides the light: indirect.frag and direct.frag add it, once per pixel and each
// time that it changes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/surface.glsl"
#include "shaders/shared/surface_pack.glsl"

// Bands of bounced light that the surface reads.
layout(constant_id = 2) const uint kBands = 3;

layout(location = 0) out vec4 outEmitted; // nits, or what views without light show; how bounced light is read, see main()
layout(location = 1) out uvec4 outSurface;
layout(location = 2) out vec4 outReceiver; // lightmap coordinates, metallic, roughness

vec3 unlit(Surface s) {
    if (kView == VIEW_ALBEDO)
        return s.albedo;
    if (kView == VIEW_NORMALS)
        return s.detailNormal * 0.5 + 0.5;
    return kView == VIEW_LIT ? emission() : vec3(0);
}

void main() {
    const Surface s = readSurface(baseColor());
    outReceiver = vec4(fragLightmapUv + vec2(0, gl_FrontFacing ? 0.0 : draw.backOffset), s.metallic, s.roughness);
    if (isBlackBack()) { // two normals that no light meets both
        outEmitted = vec4(0);
        outSurface = packSurface(vec3(0), -s.geometricNormal, s.geometricNormal);
        return;
    }
    // Bands from the lightmap are positive, from the grid negative.
    const float bands = has(FEATURE_LIGHTMAP) ? float(kBands) : has(FEATURE_GRID) ? -float(kBands) : 0.0;
    outEmitted = vec4(unlit(s), bands);
    outSurface = packSurface(s.baseColor, s.detailNormal, s.geometricNormal);
}
