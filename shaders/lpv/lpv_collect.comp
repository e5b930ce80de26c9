// SPDX-License-Identifier: MIT
// Counts the cells that a map was sent into, or lists their lobes and clears the sums. The order of the list is
// arbitrary: no cell is in it twice.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/lpv_map.glsl"
#include "shaders/shared/lpv_volume.glsl"

layout(local_size_x = LPV_GROUP_X, local_size_y = LPV_GROUP_Y, local_size_z = LPV_GROUP_Z) in;

layout(constant_id = 0) const uint kLists = 0; // 1: lists, 0: only counts

layout(std430, binding = LPV_MAP_SUMS) buffer Sums { ivec4 sums[]; };
layout(std430, binding = LPV_MAP_COUNT) buffer Count { uint count; };
layout(std430, binding = LPV_MAP_LOBES) writeonly buffer Lobes { GpuCellLobe lobes[]; };

void main() {
    const uvec3 at = gl_GlobalInvocationID, size = map.size;
    if (any(greaterThanEqual(at, size)))
        return;
    const uint cell = (at.z * size.y + at.y) * size.x + at.x;
    const ivec4 any3 = sums[3u * cell] | sums[3u * cell + 1u] | sums[3u * cell + 2u];
    if (any3 == ivec4(0))
        return;
    const uint k = atomicAdd(count, 1u);
    if (kLists == 0u)
        return;
    for (uint c = 0u; c < 3u; ++c) {
        lobes[k].color[c] = vec4(sums[3u * cell + c]) / map.scale;
        sums[3u * cell + c] = ivec4(0);
    }
    lobes[k].cell = volumeIndex(size, at);
}
