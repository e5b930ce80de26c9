// SPDX-License-Identifier: MIT
// Fills dark texels of the maps for reflections from coarser levels; a workgroup does one map. As completeGlossyMap() of
// engine/techniques/radiance_volumes/glossy_map.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_volumes.h"
#include "shaders/shared/compute_groups.glsl"
#include "shaders/shared/glossy_map.glsl"

layout(push_constant) uniform Push { GpuVolumeMaps maps; };
layout(std430, binding = VOLUME_CACHE_GLOSSY) coherent buffer Glossy { float glossy[]; };

#include "shaders/shared/glossy_texels.glsl"

shared float coarseScale[1024], fineScale[1024]; // of a level of up to 32 texels a side

void sync() {
    memoryBarrierBuffer();
    memoryBarrierShared();
    barrier();
}

void fill(uint first, uint lane) {
    for (uint t = lane; t < 1024u; t += VOLUME_CACHE_LANES)
        coarseScale[t] = 1.0;
    sync();
    for (uint level = min(maps.fill, glossyLevels(maps.tile) - 1u); level-- > 0u;) {
        const uint side = maps.tile >> (level + 1u);
        const uint fine = first + glossyFirstTexel(maps.tile, level), coarse = first + glossyFirstTexel(maps.tile, level + 1u);
        for (uint t = lane; t < side * side; t += VOLUME_CACHE_LANES) {
            const uint k = childOf(t, side);
            uint dark = 0u;
            for (uint c = 0u; c < 4u; ++c)
                dark += read(fine + k + (c & 1u) + (c >> 1) * 2u * side) == vec3(0) ? 1u : 0u;
            const float scale = dark < 4u ? 4.0 / float(4u + dark) : 1.0;
            for (uint c = 0u; c < 4u; ++c) {
                const uint child = k + (c & 1u) + (c >> 1) * 2u * side;
                const vec3 before = read(fine + child);
                const bool filled = before == vec3(0);
                write(fine + child, filled ? read(coarse + t) * scale : before * (scale * coarseScale[t]));
                if (level > 0u)
                    fineScale[child] = filled ? scale : scale * coarseScale[t];
            }
        }
        sync();
        for (uint t = lane; level > 0u && t < 4u * side * side; t += VOLUME_CACHE_LANES)
            coarseScale[t] = fineScale[t];
        sync();
    }
}

void main() {
    const uint cache = groupIndex();
    if (cache < maps.caches)
        fill(cache * glossyFirstTexel(maps.tile, glossyLevels(maps.tile)), gl_LocalInvocationID.x);
}
