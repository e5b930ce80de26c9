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
layout(location = 2) out vec4 outReceiver; // lightmap coordinates, metallic, roughness

layout(set = 0, binding = 12, std430) readonly buffer LookupSnaps { uint lookupSnaps[]; };

// kFineLookup, kFineCells, kFineLevels of engine/lightmap/lightmap_layout.h.
const uint kFineLookup = 1u << 31;
const float kFineCells = 4.0;
const int kFineLevels = 5;

/// snapLookup() of engine/lightmap/atlas.h.
vec2 snapLookup(vec2 uv) {
    vec2 p = uv * frame.lookupSize - 0.5, base = floor(p);
    if (any(lessThan(base, vec2(0))) || any(greaterThanEqual(base, frame.lookupSize)))
        return uv; // without snaps lookupSize is 0
    const uint width = uint(frame.lookupSize.x);
    uint rows = lookupSnaps[uint(base.y) * width + uint(base.x)];
    for (int level = 0; level < kFineLevels && (rows & kFineLookup) != 0u; ++level) {
        const uint block = rows & ~kFineLookup;
        p = vec2(block % width, block / width) + (p - base) * kFineCells;
        base = floor(p);
        rows = lookupSnaps[uint(base.y) * width + uint(base.x)];
    }
    vec2 f = p - base;
    const uvec2 cell = min(uvec2(f * 8.0), uvec2(7));
    const uint snap = rows == 0u || (rows & kFineLookup) != 0u
                          ? 0u : lookupSnaps[rows + cell.y] >> (4u * cell.x) & 15u;
    if (snap == 1u || snap == 2u)
        f.x = float(snap - 1u);
    else if (snap == 3u || snap == 4u)
        f.y = float(snap - 3u);
    else if (snap > 4u)
        f = vec2((snap - 5u) & 1u, (snap - 5u) >> 1);
    return (base + f + 0.5) / frame.lookupSize;
}

vec3 unlit(Surface s) {
    if (kView == VIEW_ALBEDO)
        return s.albedo;
    if (kView == VIEW_NORMALS)
        return s.detailNormal * 0.5 + 0.5;
    return kView == VIEW_LIT ? emission() : vec3(0);
}

void main() {
    const Surface s = readSurface(baseColor());
    outReceiver = vec4(snapLookup(fragLightmapUv + vec2(0, gl_FrontFacing ? 0.0 : draw.backOffset)),
                       s.metallic, s.roughness);
    if (isBlackBack()) { // opposite normals, so that no light reaches both sides
        outEmitted = vec4(0);
        outSurface = packSurface(vec3(0), -s.geometricNormal, s.geometricNormal);
        return;
    }
    // Bands from the lightmap are positive, from the grid negative. A half more: reflections are marched.
    const float read = float(kBands) + (has(FEATURE_MARCHED) ? 0.5 : 0.0);
    const float bands = has(FEATURE_LIGHTMAP) ? read : has(FEATURE_GRID) ? -read : 0.0;
    outEmitted = vec4(unlit(s), bands);
    outSurface = packSurface(s.baseColor, s.detailNormal, s.geometricNormal);
}
