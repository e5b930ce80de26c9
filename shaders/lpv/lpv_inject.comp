// SPDX-License-Identifier: MIT
// Adds the lobes of one light, times its colour, to the cells. No cell is twice in the list.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/lpv.glsl"

layout(local_size_x = LPV_LIST_LANES) in;

layout(std430, binding = LPV_FROM) buffer Light { vec4 light[]; };
layout(std430, set = 1, binding = 0) readonly buffer Lobes { GpuCellLobe lobes[]; };

void main() {
    const uint k = gl_GlobalInvocationID.x;
    if (k >= lattice.count)
        return;
    const uint cell = lobes[k].cell, cells = volumeCells(lattice.size);
    for (uint c = 0u; c < 3u; ++c)
        light[c * cells + cell] += lobes[k].color[c] * lattice.color[c];
}
