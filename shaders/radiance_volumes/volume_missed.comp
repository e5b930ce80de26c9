// SPDX-License-Identifier: MIT
// Counts the pixels of a camera's picture that find no cache: lookUpCaches() of
// engine/techniques/radiance_volumes/cache_grids.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/volume_picture.glsl"

layout(local_size_x = VOLUME_MAP_LANES, local_size_y = VOLUME_MAP_LANES) in;

layout(std430, binding = VOLUME_DEMAND_SUMS) readonly buffer Address { uint address[]; };
layout(std430, binding = VOLUME_DEMAND_MISSED) buffer Missed { uint missed; };

const float kMinWeight = 1e-6; // as cache_grids.cpp

/// Whether a grid has a cache about p.
bool lights(uint g, vec3 p) {
    const uvec3 cell = cellAt(g, p);
    const vec3 f = clamp((p - nodePlace(g, cell)) / volume.grid[g].cell, 0.0, 1.0);
    float sum = 0.0;
    for (uint k = 0u; k < 8u; ++k) {
        const vec3 w = mix(1.0 - f, f, vec3(k & 1u, k >> 1 & 1u, k >> 2));
        if (address[nodeIndex(g, cellCorner(cell, k))] != VOLUME_NO_CACHE)
            sum += w.x * w.y * w.z;
    }
    return sum >= kMinWeight;
}

void main() {
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    vec3 p, normal;
    if (any(greaterThanEqual(pixel, uvec2(picture.width, picture.height))) || !surfaceAt(pixel, p, normal))
        return;
    p = aboveSurface(p, normal);
    const GridShares shares = gridShares(p);
    bool found = false;
    for (uint g = shares.weight > 0.0 ? shares.grid : shares.grid + 1u; g < volume.count; ++g)
        found = found || lights(g, p);
    if (!found)
        atomicAdd(missed, 1u);
}
