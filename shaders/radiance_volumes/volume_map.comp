// SPDX-License-Identifier: MIT
// Reads the virtual area lights of one view of a reflective shadow map: each sums a square of texels. As areaLightsOf()
// of engine/techniques/radiance_volumes/area_lights.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/rsm_texel.glsl"
#include "shaders/shared/gpu_volumes.h"

layout(local_size_x = VOLUME_MAP_LANES, local_size_y = VOLUME_MAP_LANES) in;

layout(push_constant) uniform Push { GpuVolumeMap map; };
layout(std430, binding = VOLUME_MAP_LIGHTS) writeonly buffer Lights { GpuAreaLight lights[]; };

/// The point at `distance` that a texel of the level looks at.
vec3 placeOf(uvec2 texel, float distance) {
    const vec2 ndc = (vec2(texel) + 0.5) * (2.0 / float(map.side)) - 1.0;
    const vec3 across = ndc.x * map.view.right - ndc.y * map.view.up; // the first row is the upper one
    if (map.view.parallel == 1u)
        return map.view.origin + across + distance * map.view.forward;
    return map.view.origin + distance * normalize(map.view.forward + across);
}

void main() {
    const uvec2 place = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(place, uvec2(map.side))))
        return;
    const uint step = map.view.mapSize / map.side;
    GpuAreaLight light = GpuAreaLight(vec3(0), 0.0, vec3(0), 0.0, vec3(0), 0.0, 0.0, 0.0, 0u, 0u);
    vec3 normals = vec3(0);
    for (uint k = 0u; k < step * step; ++k) {
        RsmTexel seen;
        if (!readRsmTexel(map.view, ivec2(place * step + uvec2(k % step, k / step)), seen))
            continue;
        light.flux += seen.albedo * seen.incident;
        normals += seen.normal;
        light.disc += seen.area * 0.31830989;
        light.distance += seen.distance;
        light.squares += seen.distance * seen.distance;
        light.count += 1.0;
    }
    light.normals = length(normals);
    if (light.count > 0.0 && light.normals > 0.0) {
        light.normal = normals / light.normals;
        light.place = placeOf(place, light.distance / light.count);
    } else {
        light.flux = vec3(0);
    }
    const uint size = map.side / map.blockSide; // area lights along a block
    const uvec2 block = place / size, within = place % size;
    lights[map.firstLight + (block.y * map.blockSide + block.x) * size * size + within.y * size + within.x] = light;
}
