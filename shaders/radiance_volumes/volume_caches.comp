// SPDX-License-Identifier: MIT
// Adds the light of one light's area lights to all caches; a workgroup lights one. As lightCaches() of
// engine/techniques/radiance_volumes/cache_light.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_volumes.h"
#include "shaders/shared/compute_groups.glsl"
#include "shaders/shared/sh_bands.glsl"

layout(push_constant) uniform Push { GpuVolumeLight light; };
layout(std430, binding = VOLUME_CACHE_PLACES) readonly buffer Places { GpuCachePlace places[]; };
layout(std430, binding = VOLUME_CACHE_LIGHTS) readonly buffer Lights { GpuAreaLight lights[]; };
layout(std430, binding = VOLUME_CACHE_BLOCKS) readonly buffer Blocks { GpuLightBlock blocks[]; };
layout(std430, binding = VOLUME_CACHE_VOXELS) readonly buffer Voxels { uint voxels[]; };
layout(std430, binding = VOLUME_CACHE_HARMONICS) buffer Harmonics { float harmonics[]; };
layout(std430, binding = VOLUME_CACHE_VISIBILITY) writeonly buffer Visibility { float visibilities[]; };

#include "shaders/shared/voxel_cone.glsl"

const float kWidestSine = 0.25; // as cache_light.cpp
shared float partial[VOLUME_CACHE_LANES * 27u];

/// blockVisibility().
float visibility(GpuLightBlock block, vec3 raised) {
    if (light.shadows == VOLUME_SHADOWS_NONE)
        return 1.0;
    const vec3 to = block.place + light.raise * block.normal;
    float sine = light.shadows == VOLUME_SHADOWS_PUBLISHED ? block.width : block.width / 2.0;
    if (light.parallel == 1u)
        sine /= max(distance(raised, to), sine);
    return coneVisibility(light.voxelSide, light.shadows, (raised - light.voxelLower) / light.voxelCell,
                          (to - light.voxelLower) / light.voxelCell, min(sine, kWidestSine));
}

/// Whether any area light of a block faces the cache.
bool faces(uint block, vec3 p) {
    for (uint k = 0u; k < light.blockLights; ++k) {
        const GpuAreaLight a = lights[block * light.blockLights + k];
        if (a.flux != vec3(0) && dot(p - a.place, a.normal) > 0.0)
            return true;
    }
    return false;
}

/// Adds a block's light.
void gather(uint block, float visible, vec3 p, inout vec3 sum[kCoefficients]) {
    for (uint k = 0u; k < light.blockLights; ++k) {
        const GpuAreaLight a = lights[block * light.blockLights + k];
        const vec3 way = a.place - p;
        const float squared = dot(way, way), reach = sqrt(squared);
        const vec3 d = way * (reach > 0.0 ? 1.0 / reach : 0.0);
        const float factor = 0.31830989 * max(-dot(d, a.normal), 0.0) * visible / max(squared + a.disc, 1e-37);
        float y[kCoefficients];
        shBasis(d, y);
        [[unroll]] for (int i = 0; i < kCoefficients; ++i)
            sum[i] += factor * y[i] * a.flux;
    }
}

void main() {
    const uint cache = groupIndex(), lane = gl_LocalInvocationID.x;
    vec3 sum[kCoefficients];
    [[unroll]] for (int i = 0; i < kCoefficients; ++i)
        sum[i] = vec3(0);
    if (cache < light.caches) {
        const vec3 p = places[cache].position, raised = places[cache].raised;
        for (uint b = lane; b < light.blocks; b += VOLUME_CACHE_LANES) {
            const GpuLightBlock block = blocks[b];
            const bool faced = block.lit > 0u && faces(b, p);
            const float visible = faced ? visibility(block, raised) : 0.0;
            if (light.keepsVisibility == 1u)
                visibilities[cache * light.blocks + b] = visible;
            if (visible > 0.0)
                gather(b, visible, p, sum);
        }
    }
    [[unroll]] for (int i = 0; i < kCoefficients; ++i)
        for (int c = 0; c < 3; ++c)
            partial[lane * 27u + uint(3 * i + c)] = sum[i][c];
    barrier();
    if (cache >= light.caches || lane >= uint(3 * kCoefficients))
        return;
    float total = 0.0;
    for (uint k = 0u; k < VOLUME_CACHE_LANES; ++k)
        total += partial[k * 27u + lane];
    total *= light.colour[lane % 3u];
    const uint place = cache * uint(3 * kCoefficients) + lane;
    harmonics[place] = light.first == 1u ? total : harmonics[place] + total;
}
