// SPDX-License-Identifier: MIT
// Finds the largest magnitude of the field's values. Bits of floats that are not negative are ordered as the floats, so
// that the result does not depend on the order of invocations.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/lpv_cell.glsl"

layout(std430, binding = LPV_SUM) readonly buffer Sum { vec4 sum[]; };
layout(std430, binding = LPV_BRIGHTEST) buffer Brightest { uint brightest; };

shared uint groupBrightest;

void main() {
    if (gl_LocalInvocationIndex == 0u)
        groupBrightest = 0u;
    barrier();
    if (isInside(gl_GlobalInvocationID)) {
        const uint cell = volumeIndex(lattice.size, gl_GlobalInvocationID), cells = volumeCells(lattice.size);
        float most = 0.0;
        for (uint c = 0u; c < 3u; ++c) {
            const vec4 values = abs(sum[c * cells + cell] * vec4(vec3(lattice.slope), lattice.mean));
            for (int i = 0; i < 4; ++i)
                most = values[i] > most ? values[i] : most; // not where it is NaN
        }
        atomicMax(groupBrightest, floatBitsToUint(most));
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u)
        atomicMax(brightest, groupBrightest);
}
