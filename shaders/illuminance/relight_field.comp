// SPDX-License-Identifier: MIT
// Writes the bands of the caches order[range.begin, range.end) into the lightmap and the grid that the viewport
// samples, one layer per invocation.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/field_value.glsl"
#include "shaders/shared/relight.glsl"
#include "shaders/shared/sh_bands.glsl"

layout(std430, binding = RELIGHT_CACHES) readonly buffer Caches { GpuCache caches[]; };
layout(std430, binding = RELIGHT_ORDER) readonly buffer Order { uint order[]; };
layout(std430, binding = RELIGHT_SH) readonly buffer Sh { vec4 sh[]; };
layout(std430, binding = RELIGHT_GRID) writeonly buffer Grid { uvec2 grid[]; };
layout(binding = RELIGHT_LIGHTMAP, rgba16f) uniform writeonly image2DArray lightmap;

layout(constant_id = 2) const int kChromaBands = 3; // [1, kBands]

// As engine/field/field_packing.h: coefficients in colour, then grey ones, in layers of four values.
const int kColoured = kChromaBands * kChromaBands;
const int kValues = kCoefficients + 2 * kColoured;
const int kLayers = (kValues + 3) / 4;

float valueOf(uint cache, int v) {
    if (v >= kValues)
        return 0.0;
    const int i = v < 3 * kColoured ? v / 3 : v - 2 * kColoured;
    return fieldValue(sh[cache * kCoefficients + i][v < 3 * kColoured ? v % 3 : 0] * range.fieldScale);
}

void main() {
    const uint item = groupIndex() * kLanes + gl_LocalInvocationIndex;
    const uint k = range.begin + item / kLayers;
    const int layer = int(item % kLayers);
    if (k >= range.end)
        return;
    const uint c = order[k];
    const uint texel = caches[c].texel, width = imageSize(lightmap).x;
    const vec4 values = vec4(valueOf(c, 4 * layer), valueOf(c, 4 * layer + 1), valueOf(c, 4 * layer + 2),
                             valueOf(c, 4 * layer + 3));
    if (c < range.lightmapCaches)
        imageStore(lightmap, ivec3(texel % width, texel / width, layer), values);
    else
        grid[layer * range.gridCells + texel] = uvec2(packHalf2x16(values.xy), packHalf2x16(values.zw));
}
