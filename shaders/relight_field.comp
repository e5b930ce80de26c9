// SPDX-License-Identifier: MIT
// The bands of the caches order[range.begin, range.end) into the lightmap and the grid that the viewport samples, one coefficient per invocation.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/relight.glsl"
#include "shaders/shared/sh_bands.glsl"

layout(std430, binding = RELIGHT_CACHES) readonly buffer Caches { GpuCache caches[]; };
layout(std430, binding = RELIGHT_ORDER) readonly buffer Order { uint order[]; };
layout(std430, binding = RELIGHT_SH) readonly buffer Sh { vec4 sh[]; };
layout(std430, binding = RELIGHT_GRID) writeonly buffer Grid { vec4 grid[]; };
layout(binding = RELIGHT_LIGHTMAP, rgba32f) uniform writeonly image2DArray lightmap;

void main() {
    const uint item = groupIndex() * kLanes + gl_LocalInvocationIndex;
    const uint k = range.begin + item / kCoefficients, i = item % kCoefficients;
    if (k >= range.end)
        return;
    const uint c = order[k];
    const uint texel = caches[c].texel, width = imageSize(lightmap).x;
    const vec4 value = sh[c * kCoefficients + i];
    if (c < range.lightmapCaches)
        imageStore(lightmap, ivec3(texel % width, texel / width, i), value);
    else
        grid[i * range.gridCells + texel] = value;
}
