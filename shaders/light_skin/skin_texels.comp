// SPDX-License-Identifier: MIT
// Writes the virtual area lights of one view of a reflective shadow map, as castVirtualLights() of
// engine/techniques/light_skin/virtual_lights.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_skin_steps.h"
#include "shaders/shared/rsm_texel.glsl"

layout(local_size_x = SKIN_MAP_LANES, local_size_y = SKIN_MAP_LANES) in;

layout(push_constant) uniform Push { GpuSkinMap map; };
layout(std430, binding = SKIN_STEP_TEXELS) writeonly buffer Texels { GpuVirtualLight texels[]; };

/// Area of the texel's piece of surface across the beam.
float areaAcross(vec3 position) {
    if (map.view.parallel == 1u)
        return map.view.texelArea;
    const vec3 way = position - map.view.origin;
    const float distance = length(way), length1 = distance / dot(way, map.view.forward);
    return map.view.texelArea / (length1 * length1 * length1) * distance * distance;
}

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(map.view.mapSize))))
        return;
    RsmTexel seen;
    GpuVirtualLight light = GpuVirtualLight(vec3(0), 0.0, vec3(0), 0u);
    if (readRsmTexel(map.view, texel, seen))
        light = GpuVirtualLight(seen.position, areaAcross(seen.position), seen.albedo * seen.incident,
                                packSnorm2x16(octEncode(seen.normal)));
    // In the order of castRsm(), whose rows run upwards, so that draws choose the same texels.
    ivec2 place = ivec2(texel.x, int(map.view.mapSize) - 1 - texel.y);
    if (map.turned == 1u)
        place = place.yx;
    texels[(map.column + uint(place.x)) * map.view.mapSize + uint(place.y)] = light;
}
