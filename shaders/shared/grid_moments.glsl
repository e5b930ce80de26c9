// SPDX-License-Identifier: MIT
// Weight of a cell of the grid by the moments of its distances, as in engine/field/grid_moments.h. Needs gridDepth[] with
// the moments' floats, and gridDepthPlace() and gridDepthTexel() of grid_depth.glsl.

float momentsWeight(uint cell, vec3 way, vec3 normal, bool smoothWeights) {
    const uint first = cell * uint(GRID_DEPTH_SIDE * GRID_DEPTH_SIDE);
    const float r = length(way);
    const vec2 at = gridDepthPlace(way);
    const vec2 base = floor(at), f = at - base;
    vec2 moments = vec2(0);
    for (int k = 0; k < 4; ++k) {
        const ivec2 high = ivec2(k & 1, k >> 1);
        const vec2 w = mix(1.0 - f, f, vec2(high));
        const ivec2 texel = ivec2(base) + high;
        const uint i = 2u * (first + gridDepthTexel(texel.x, texel.y));
        moments += w.x * w.y * vec2(uintBitsToFloat(gridDepth[i]), uintBitsToFloat(gridDepth[i + 1u]));
    }
    if (!(moments.y > 0.0)) // the cell lies in a solid
        return 0.0;
    if (!(r > 0.0))
        return 1.0;
    const float variance = max(moments.y - moments.x * moments.x, 0.0), excess = r - moments.x;
    const float seen = excess <= 0.0 ? 1.0 : variance / (variance + excess * excess);
    const float facing = -dot(normal, way) / r;
    if (!smoothWeights)
        return max(max(MOMENTS_LEAST_FACING, facing) * seen, MOMENTS_LEAST_WEIGHT);
    const float wrapped = (facing + 1.0) / 2.0;
    const float weight = max((wrapped * wrapped + MOMENTS_WRAP) * seen * seen * seen, MOMENTS_SMOOTH_LEAST);
    return weight < MOMENTS_CRUSHED ? weight * weight * weight / (MOMENTS_CRUSHED * MOMENTS_CRUSHED) : weight;
}
