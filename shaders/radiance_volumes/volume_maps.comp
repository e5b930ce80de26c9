// SPDX-License-Identifier: MIT
// Adds one light's area lights to the maps for reflections of all caches, or makes their coarser levels; an invocation
// does one map, so that area lights are added in their order. As engine/techniques/radiance_volumes/glossy_map.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_volumes.h"
#include "shaders/shared/compute_groups.glsl"
#include "shaders/shared/glossy_map.glsl"

layout(push_constant) uniform Push { GpuVolumeMaps maps; };
layout(std430, binding = VOLUME_CACHE_PLACES) readonly buffer Places { GpuCachePlace places[]; };
layout(std430, binding = VOLUME_CACHE_LIGHTS) readonly buffer Lights { GpuAreaLight lights[]; };
layout(std430, binding = VOLUME_CACHE_VISIBILITY) readonly buffer Visibility { float visibilities[]; };
layout(std430, binding = VOLUME_CACHE_GLOSSY) buffer Glossy { float glossy[]; };

#include "shaders/shared/glossy_texels.glsl"

/// Adds a block's area lights.
void addBlock(uint block, float visible, vec3 p, mat3 frame, uint first) {
    for (uint j = block * maps.blockLights; j < (block + 1u) * maps.blockLights; ++j) {
        const GpuAreaLight a = lights[j];
        const vec3 way = a.place - p;
        const float squared = dot(way, way), reach = sqrt(squared);
        const vec3 d = way * (reach > 0.0 ? 1.0 / reach : 0.0);
        const float arrives = 0.31830989 * max(-dot(d, a.normal), 0.0) * visible / max(squared + a.disc, 1e-37);
        float factor;
        const uint texel = first + glossySplat(maps.tile, maps.microfacet == 1u, frame, d, factor);
        if (arrives > 0.0)
            write(texel, read(texel) + a.flux * maps.colour * (arrives * factor));
    }
}

void averageLevels(uint first) {
    for (uint level = 1u; level < glossyLevels(maps.tile); ++level) {
        const uint side = maps.tile >> level;
        const uint fine = first + glossyFirstTexel(maps.tile, level - 1u), coarse = first + glossyFirstTexel(maps.tile, level);
        for (uint t = 0u; t < side * side; ++t) {
            const uint k = fine + childOf(t, side);
            write(coarse + t, (read(k) + read(k + 1u) + read(k + 2u * side) + read(k + 2u * side + 1u)) * 0.25);
        }
    }
}

void main() {
    const uint cache = groupIndex() * VOLUME_CACHE_LANES + gl_LocalInvocationID.x;
    if (cache >= maps.caches)
        return;
    const uint first = cache * glossyFirstTexel(maps.tile, glossyLevels(maps.tile));
    if (maps.blocks == 0u) {
        averageLevels(first);
        return;
    }
    for (uint t = 0u; maps.first == 1u && t < maps.tile * maps.tile; ++t)
        write(first + t, vec3(0));
    const vec3 p = places[cache].position;
    const mat3 frame = glossyFrame(maps.eye - p);
    for (uint b = 0u; b < maps.blocks; ++b) {
        const float visible = visibilities[cache * maps.blocks + b];
        if (visible > 0.0)
            addBlock(b, visible, p, frame, first);
    }
}
