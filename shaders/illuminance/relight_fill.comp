// SPDX-License-Identifier: MIT
// Fills the invalid caches [range.begin, range.end) of the list from the valid ones that replace them, one coefficient
// per invocation.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/relight.glsl"
#include "shaders/shared/sh_bands.glsl"

layout(std430, binding = RELIGHT_SH) buffer Sh { vec4 sh[]; };
layout(std430, binding = RELIGHT_FILLS) readonly buffer Fills { GpuFill fills[]; };
layout(std430, binding = RELIGHT_FILL_SOURCES) readonly buffer Sources { uvec2 sources[]; };

void main() {
    const uint item = groupIndex() * kLanes + gl_LocalInvocationIndex;
    const uint f = range.begin + item / kCoefficients, i = item % kCoefficients;
    if (f >= range.end)
        return;
    const GpuFill fill = fills[f];
    vec3 sum = vec3(0);
    for (uint k = fill.begin; k < fill.end; ++k)
        sum += sh[sources[k].x * kCoefficients + i].rgb * uintBitsToFloat(sources[k].y);
    sh[fill.cache * kCoefficients + i] = vec4(sum, 0);
}
