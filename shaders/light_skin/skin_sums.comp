// SPDX-License-Identifier: MIT
// Sums importance, flux and area down the columns of a map, an invocation a column, and then, by one invocation, along the
// columns' sums. The order is fixed, so that repeats are equal.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/compute_groups.glsl"
#include "shaders/shared/gpu_skin_steps.h"

layout(constant_id = 1) const bool kAlong = false; // the columns' sums, else down the columns

layout(push_constant) uniform Push { GpuSkinStep step; };
layout(std430, binding = SKIN_STEP_TEXELS) readonly buffer Texels { GpuVirtualLight texels[]; };
layout(std430, binding = SKIN_STEP_IMPORTANCE) readonly buffer Importance { float importance[]; };
layout(std430, binding = SKIN_STEP_SUMS) buffer Sums { float sums[]; };

void main() {
    const uint column = groupIndex() * kLanes + gl_LocalInvocationID.x, all = step.columns * step.rows;
    if (!kAlong && column < step.columns) {
        vec3 sum = vec3(0);
        for (uint i = column * step.rows; i < (column + 1u) * step.rows; ++i) {
            sum += vec3(importance[i], dot(texels[i].flux, vec3(0.2126, 0.7152, 0.0722)), texels[i].area);
            sums[i] = sum.x;
            sums[all + i] = sum.y;
            sums[2u * all + i] = sum.z;
        }
    }
    if (kAlong && column == 0u) {
        vec3 sum = vec3(0);
        for (uint k = 0u; k < step.columns; ++k) {
            const uint last = (k + 1u) * step.rows - 1u;
            sum += vec3(sums[last], sums[all + last], sums[2u * all + last]);
            sums[3u * all + k] = sum.x;
            sums[3u * all + step.columns + k] = sum.y;
            sums[3u * all + 2u * step.columns + k] = sum.z;
        }
    }
}
