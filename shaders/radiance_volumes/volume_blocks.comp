// SPDX-License-Identifier: MIT
// Sums the area lights of each block of a view. As areaLightsOf() of
// engine/techniques/radiance_volumes/area_lights.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_volumes.h"

layout(local_size_x = VOLUME_MAP_LANES, local_size_y = VOLUME_MAP_LANES) in;

layout(push_constant) uniform Push { GpuVolumeMap map; };
layout(std430, binding = VOLUME_MAP_LIGHTS) readonly buffer Lights { GpuAreaLight lights[]; };
layout(std430, binding = VOLUME_MAP_BLOCKS) writeonly buffer Blocks { GpuLightBlock blocks[]; };

void main() {
    const uvec2 place = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(place, uvec2(map.blockSide))))
        return;
    const uint number = place.y * map.blockSide + place.x, size = map.side / map.blockSide;
    GpuLightBlock block = GpuLightBlock(vec3(0), 0.0, vec3(0), 0u);
    float count = 0.0, placed = 0.0, distance = 0.0, squares = 0.0;
    for (uint k = 0u; k < size * size; ++k) {
        const GpuAreaLight light = lights[map.firstLight + number * size * size + k];
        count += light.count;
        distance += light.distance;
        squares += light.squares;
        block.normal += light.normal * light.normals;
        if (light.flux == vec3(0))
            continue;
        ++block.lit;
        block.place += light.place * light.count;
        placed += light.count;
    }
    if (block.lit > 0u) {
        block.place /= placed;
        const float all = length(block.normal), mean = distance / count;
        block.normal = all > 0.0 ? block.normal / all : vec3(0);
        const float deviation = sqrt(max(squares / count - mean * mean, 0.0));
        const float width = 2.0 * sqrt(length(map.view.right) * length(map.view.up)) / float(map.blockSide);
        block.width = max(width, 2.0 * deviation / (map.view.parallel == 1u ? 1.0 : mean));
    }
    blocks[map.firstBlock + number] = block;
}
