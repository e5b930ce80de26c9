// SPDX-License-Identifier: MIT
// Fills the field's grid, a cell per lane, with the mean of the eight probes nearest to each cell, without regard to
// walls. The layers hold four values each, as engine/field/field_packing.h says; all bands are in colour.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/field_value.glsl"
#include "shaders/shared/sparse.glsl"

layout(std430, binding = SPARSE_PROBES) readonly buffer Probes { vec4 probes[]; };
layout(std430, binding = SPARSE_CELLS) readonly buffer Cells { uint cells[]; };
layout(std430, binding = SPARSE_GRID) writeonly buffer Grid { uvec2 grid[]; };

float valueOf(uint cell, uint v) {
    const uint i = v / 3;
    float sum = 0.0;
    const uint at = cell * 2 * SPARSE_PROBES_PER_RECEIVER;
    if (i < range.coefficients && i < kCoefficients)
        for (uint k = 0; k < SPARSE_PROBES_PER_RECEIVER; ++k)
            sum += uintBitsToFloat(cells[at + SPARSE_PROBES_PER_RECEIVER + k]) * probes[cells[at + k] * kRow + i][v % 3];
    return fieldValue(sum * range.fieldScale);
}

void main() {
    const uint cell = itemIndex();
    if (cell >= range.end)
        return;
    const uint layers = (3 * range.coefficients + 3) / 4;
    for (uint layer = 0; layer < layers; ++layer)
        grid[layer * range.end + cell] =
            uvec2(packHalf2x16(vec2(valueOf(cell, 4 * layer), valueOf(cell, 4 * layer + 1))),
                  packHalf2x16(vec2(valueOf(cell, 4 * layer + 2), valueOf(cell, 4 * layer + 3))));
}
