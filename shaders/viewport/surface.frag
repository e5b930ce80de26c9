// SPDX-License-Identifier: MIT
// Writes all that shading needs of a surface besides the light. indirect.frag and direct.frag add the light, once per
// pixel and each time that it changes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/surface.glsl"
#include "shaders/shared/surface_pack.glsl"

// Bands of bounced light that the surface reads.
layout(constant_id = 2) const uint kBands = 3;

layout(location = 0) out vec4 outEmitted; // nits, or what views without light show; how bounced light is read, see main()
layout(location = 1) out uvec4 outSurface;
// Lightmap coordinates, or, without a lightmap, the instance's number and 0; packMetallic(), packRoughness()
layout(location = 2) out vec4 outReceiver;

#include "shaders/shared/lookup_snaps.glsl"

vec3 unlit(Surface s) {
    if (kView == VIEW_ALBEDO)
        return s.albedo;
    if (kView == VIEW_NORMALS)
        return s.detailNormal * 0.5 + 0.5;
    return kView == VIEW_LIT ? emission() : vec3(0);
}

void main() {
    const Surface s = readSurface(baseColor());
    float width;
    const vec2 lookup = snapLookup(fragLightmapUv + vec2(0, gl_FrontFacing ? 0.0 : draw.backOffset), width);
    outReceiver = vec4(has(FEATURE_LIGHTMAP) ? lookup : vec2(float(draw.instance), 0),
                       packMetallic(s.metallic, material.transmission), packRoughness(s.roughness, material.dielectricF0));
    if (isBlackBack()) { // opposite normals, so that no light reaches both sides
        outEmitted = vec4(0);
        outSurface = packSurface(s.baseColor * material.transmission, -s.geometricNormal, s.geometricNormal, 0.0);
        outReceiver.z = packMetallic(s.metallic, material.transmission > 0.0 ? 1.0 : 0.0);
        return;
    }
    // Bands from the lightmap are positive, from the grid negative. A half more: a technique's own pass adds
    // what the surface reflects glossily.
    const float read = float(kBands) + (has(FEATURE_REFLECTED_APART) ? 0.5 : 0.0);
    const float bands = has(FEATURE_LIGHTMAP) ? read : has(FEATURE_GRID) ? -read : 0.0;
    outEmitted = vec4(unlit(s), bands);
    outSurface = packSurface(s.baseColor, s.detailNormal, s.geometricNormal, draw.nearReach * width);
}
