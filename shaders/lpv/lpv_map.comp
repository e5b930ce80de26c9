// SPDX-License-Identifier: MIT
// Sends the texels of one view of a reflective shadow map into the cells half a cell off their surfaces, each as a
// clamped cosine of the flux that it reflects. Sums are integers, so that they do not depend on the order of
// invocations. As injectLight() of engine/techniques/lpv/injected_lights.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/lpv_map.glsl"
#include "shaders/shared/rsm_texel.glsl"

layout(local_size_x = LPV_MAP_LANES, local_size_y = LPV_MAP_LANES) in;

layout(std430, binding = LPV_MAP_SUMS) buffer Sums { int sums[]; };

const float kInversePi = 0.31830989;

void send(vec3 position, vec3 normal, vec3 weight) {
    const vec3 off = position + normal * (map.cell * 0.5);
    const uvec3 at = uvec3(clamp((off - map.lower) / map.cell, vec3(0.0), vec3(map.size) - 0.5));
    const uint cell = (at.z * map.size.y + at.y) * map.size.x + at.x;
    const vec4 lobe = vec4(normal * LPV_COSINE_SLOPE, LPV_COSINE_MEAN) * map.scale;
    for (uint c = 0u; c < 3u; ++c) {
        const ivec4 share = ivec4(round(lobe * weight[c]));
        for (uint i = 0u; i < 4u; ++i)
            atomicAdd(sums[12u * cell + 4u * c + i], share[i]);
    }
}

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(map.view.mapSize))))
        return;
    RsmTexel seen;
    if (readRsmTexel(map.view, texel, seen))
        send(seen.position, seen.normal, seen.albedo * (seen.incident * kInversePi));
}
