// SPDX-License-Identifier: MIT
// Chooses virtual lights by their importance, their flux and their area, as drawLights() of
// engine/techniques/light_skin/importance.cpp, or copies a batch of all of them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/compute_groups.glsl"
#include "shaders/shared/gpu_skin_steps.h"
#include "shaders/shared/surface_pack.glsl"
#include "shaders/shared/halton.glsl"

layout(push_constant) uniform Push { GpuSkinStep step; };
layout(std430, binding = SKIN_STEP_TEXELS) readonly buffer Texels { GpuVirtualLight texels[]; };
layout(std430, binding = SKIN_STEP_IMPORTANCE) readonly buffer Importance { float importance[]; };
layout(std430, binding = SKIN_STEP_SUMS) readonly buffer Sums { float sums[]; };
layout(std430, binding = SKIN_STEP_DRAWS) buffer Draws { GpuLightDraw draws[]; };
layout(std430, binding = SKIN_STEP_CHOSEN) writeonly buffer Chosen { GpuChosenLight chosen[]; };

/// Index in [first, first + count) of the first sum that exceeds `place`, or, where rounding leaves none, of the first
/// that is as large as the last.
uint firstAbove(uint first, uint count, float place) {
    const float total = sums[first + count - 1u];
    uint low = first, high = first + count - 1u;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        if (sums[middle] > place || sums[middle] >= total)
            high = middle;
        else
            low = middle + 1u;
    }
    return low;
}

GpuChosenLight weighted(uint i, float weight) {
    const GpuVirtualLight light = texels[i];
    const vec3 normal = octDecode(unpackSnorm2x16(light.normal));
    return GpuChosenLight(light.position, light.area, normal, light.area > 0.0 ? weight : 0.0, light.flux * weight, 0.0);
}

/// Makes draw k, if it is of the part that is made again.
void drawAgain(uint k) {
    const uint all = step.columns * step.rows, ofColumns = 3u * all;
    const vec3 total = vec3(sums[ofColumns + step.columns - 1u], sums[ofColumns + 2u * step.columns - 1u],
                            sums[ofColumns + 3u * step.columns - 1u]);
    uint defensive = step.defensive; // of the draws
    if (!(total.x > 0.0) && defensive > 0u)
        defensive = step.count; // nothing is important
    if (!(total.y > 0.0) || (defensive == 0u && !(total.x > 0.0))) {
        draws[k] = GpuLightDraw(0u, 0.0);
        return;
    }
    // Importance, flux, area. Each kind of draw has a sequence of its own, and its own part of it is made again.
    const uvec3 counts = uvec3(step.count - defensive, defensive - defensive / 2u, defensive / 2u);
    const uint kind = k < counts.x ? 0u : k < counts.x + counts.y ? 1u : 2u;
    const uint number = k - (kind > 0u ? counts.x : 0u) - (kind > 1u ? counts.y : 0u), count = counts[kind];
    if (number < count * step.block / step.blocks || number >= count * (step.block + 1u) / step.blocks)
        return;
    const vec2 u = haltonPoint(number);
    const uint first = ofColumns + kind * step.columns;
    const uint column = firstAbove(first, step.columns, u.x * total[kind]) - first;
    const uint top = kind * all + column * step.rows;
    const uint i = firstAbove(top, step.rows, u.y * sums[top + step.rows - 1u]) - kind * all;
    const vec3 value = vec3(importance[i], dot(texels[i].flux, vec3(0.2126, 0.7152, 0.0722)), texels[i].area);
    float expected = 0.0; // N P
    for (uint j = 0u; j < 3u; ++j)
        if (counts[j] > 0u)
            expected += float(counts[j]) * value[j] / total[j];
    draws[k] = GpuLightDraw(i, 1.0 / expected);
}

void main() {
    const uint k = groupIndex() * kLanes + gl_LocalInvocationID.x;
    if (k >= step.count)
        return;
    if (step.all == 1u) {
        chosen[k] = weighted(step.first + k, 1.0);
        return;
    }
    drawAgain(k);
    chosen[k] = weighted(draws[k].texel, draws[k].weight);
}
