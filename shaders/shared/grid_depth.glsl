// SPDX-License-Identifier: MIT
// Visibility of a point from the cells of the grid, as in engine/field/grid_depth.h. Needs gridDepth[] with two values
// per word.
#include "shaders/shared/grid_lookup.h"
#include "shaders/shared/octahedron.glsl"

// Maps a texel beyond the map's border to one within it: the square's sides are folded at their middle.
uint gridDepthTexel(int x, int y) {
    if (x < 0 || x >= GRID_DEPTH_SIDE) {
        x = x < 0 ? -1 - x : 2 * GRID_DEPTH_SIDE - 1 - x;
        y = GRID_DEPTH_SIDE - 1 - y;
    }
    if (y < 0 || y >= GRID_DEPTH_SIDE) {
        y = y < 0 ? -1 - y : 2 * GRID_DEPTH_SIDE - 1 - y;
        x = GRID_DEPTH_SIDE - 1 - x;
    }
    return uint(y * GRID_DEPTH_SIDE + x);
}

// Place of direction `way` in the map [texels], from the centre of the first texel.
vec2 gridDepthPlace(vec3 way) {
    vec2 p = way.xy / max(norm1(way), 1e-30);
    if (way.z < 0.0)
        p = vec2(unfolded(1.0 - abs(p.y), way.x), unfolded(1.0 - abs(p.x), way.y));
    return (p * 0.5 + 0.5) * float(GRID_DEPTH_SIDE) - 0.5;
}

float seenFromCell(uint cell, vec3 way, float reach) {
    const float length1 = norm1(way);
    const uint first = cell * uint(GRID_DEPTH_SIDE * GRID_DEPTH_SIDE);
    const vec2 at = gridDepthPlace(way);
    const vec2 base = floor(at), f = at - base;
    float inverse = 0.0;
    for (int k = 0; k < 4; ++k) {
        const ivec2 high = ivec2(k & 1, k >> 1);
        const vec2 w = mix(1.0 - f, f, vec2(high));
        const ivec2 texel = ivec2(base) + high;
        const uint i = first + gridDepthTexel(texel.x, texel.y);
        inverse += w.x * w.y * float(gridDepth[i >> 1] >> (16u * (i & 1u)) & 0xffffu);
    }
    if (length1 == 0.0)
        return inverse == 65535.0 ? 0.0 : 1.0;
    const float share = length1 * inverse * (GRID_DEPTH_SCALE / 65535.0 / reach);
    return clamp((GRID_HIDDEN - share) * GRID_FALLOFF, 0.0, 1.0);
}
