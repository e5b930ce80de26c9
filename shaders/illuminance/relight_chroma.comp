// SPDX-License-Identifier: MIT
// Makes the bands from kChromaBands on grey for the caches order[range.begin, range.end), one coefficient per
// invocation.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/relight.glsl"
#include "shaders/shared/sh_bands.glsl"

layout(constant_id = 2) const int kChromaBands = 3;

layout(std430, binding = RELIGHT_ORDER) readonly buffer Order { uint order[]; };
layout(std430, binding = RELIGHT_SH) buffer Sh { vec4 sh[]; };

void main() {
    const uint item = groupIndex() * kLanes + gl_LocalInvocationIndex;
    const uint k = range.begin + item / kCoefficients, i = item % kCoefficients;
    if (k >= range.end || i < kChromaBands * kChromaBands)
        return;
    const uint at = order[k] * kCoefficients + i;
    const vec3 c = sh[at].rgb;
    sh[at] = vec4(vec3(c.g * 0.5 + (c.r + c.b) * 0.25), 0);
}
