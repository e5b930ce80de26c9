// SPDX-License-Identifier: MIT
// Adds one light's area lights to the maps for reflections of all caches, or completes these maps; a workgroup does one.
// As engine/techniques/radiance_volumes/glossy_map.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_volumes.h"
#include "shaders/shared/compute_groups.glsl"
#include "shaders/shared/glossy_map.glsl"

layout(push_constant) uniform Push { GpuVolumeMaps maps; };
layout(std430, binding = VOLUME_CACHE_PLACES) readonly buffer Places { GpuCachePlace places[]; };
layout(std430, binding = VOLUME_CACHE_LIGHTS) readonly buffer Lights { GpuAreaLight lights[]; };
layout(std430, binding = VOLUME_CACHE_VISIBILITY) readonly buffer Visibility { float visibilities[]; };
layout(std430, binding = VOLUME_CACHE_GLOSSY) coherent buffer Glossy { float glossy[]; };

const uint kNoTexel = 0xffffffffu;
shared uint splatTexel[VOLUME_CACHE_LANES];
shared vec3 splatLight[VOLUME_CACHE_LANES];
shared float coarseScale[1024], fineScale[1024]; // of a level of up to 32 texels a side

vec3 read(uint texel) {
    return vec3(glossy[3u * texel], glossy[3u * texel + 1u], glossy[3u * texel + 2u]);
}

void write(uint texel, vec3 value) {
    glossy[3u * texel] = value.r;
    glossy[3u * texel + 1u] = value.g;
    glossy[3u * texel + 2u] = value.b;
}

void sync() {
    memoryBarrierBuffer();
    memoryBarrierShared();
    barrier();
}

/// Each lane finds the texel of one area light; each adds those of its own texels, in the area lights' order.
void addLights(uint cache, uint first, uint lane) {
    const vec3 p = places[cache].position;
    const mat3 frame = glossyFrame(maps.eye - p);
    const uint count = maps.blocks * maps.blockLights;
    for (uint base = 0u; base < count; base += VOLUME_CACHE_LANES) {
        const uint j = base + lane;
        splatTexel[lane] = kNoTexel;
        const float visible = j < count ? visibilities[cache * maps.blocks + j / maps.blockLights] : 0.0;
        if (visible > 0.0) {
            const GpuAreaLight a = lights[j];
            const vec3 way = a.place - p;
            const float squared = dot(way, way), reach = sqrt(squared);
            const vec3 d = way * (reach > 0.0 ? 1.0 / reach : 0.0);
            const float arrives = 0.31830989 * max(-dot(d, a.normal), 0.0) * visible / max(squared + a.disc, 1e-37);
            float factor;
            const uint texel = glossySplat(maps.tile, frame, d, factor);
            if (arrives > 0.0)
                splatTexel[lane] = texel;
            splatLight[lane] = a.flux * maps.colour * (arrives * factor);
        }
        sync();
        for (uint k = 0u; k < VOLUME_CACHE_LANES; ++k)
            if (splatTexel[k] != kNoTexel && splatTexel[k] % VOLUME_CACHE_LANES == lane)
                write(first + splatTexel[k], read(first + splatTexel[k]) + splatLight[k]);
        sync();
    }
}

/// The first of the four texels below texel `t` of a level with that many along its side.
uint childOf(uint t, uint side) {
    return 4u * (t / side) * side + 2u * (t % side);
}

void averageLevels(uint first, uint lane) {
    for (uint level = 1u; level < glossyLevels(maps.tile); ++level) {
        const uint side = maps.tile >> level;
        const uint fine = first + glossyFirstTexel(maps.tile, level - 1u), coarse = first + glossyFirstTexel(maps.tile, level);
        for (uint t = lane; t < side * side; t += VOLUME_CACHE_LANES) {
            const uint k = fine + childOf(t, side);
            write(coarse + t, (read(k) + read(k + 1u) + read(k + 2u * side) + read(k + 2u * side + 1u)) * 0.25);
        }
        sync();
    }
}

/// completeGlossyMap() after averaging.
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
    const uint cache = groupIndex(), lane = gl_LocalInvocationID.x;
    if (cache >= maps.caches)
        return;
    const uint texels = glossyFirstTexel(maps.tile, glossyLevels(maps.tile));
    const uint first = cache * texels;
    if (maps.first == 1u) {
        for (uint t = lane; t < maps.tile * maps.tile; t += VOLUME_CACHE_LANES)
            write(first + t, vec3(0));
        sync();
    }
    if (maps.blocks > 0u) {
        addLights(cache, first, lane);
        return;
    }
    averageLevels(first, lane);
    fill(first, lane);
}
