// SPDX-License-Identifier: MIT
// Adds the light of caches that lie around what the picture shows: VolumePart of
// engine/techniques/radiance_volumes/volume_part.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/light_pass.glsl"
#include "shaders/shared/gpu_volumes.h"
#define SH_BANDS_CONSTANT 2
#include "shaders/shared/sh_bands.glsl"
#include "shaders/shared/sh_field.glsl"
#include "shaders/shared/glossy_map.glsl"

layout(set = 0, binding = FRAME_REFLECTIONS) uniform sampler2DArray reflectionTable;
layout(set = 1, binding = VOLUME_GRIDS, std430) readonly buffer Grids { GpuCacheGrids volume; };
layout(set = 1, binding = VOLUME_ADDRESS, std430) readonly buffer Address { uint address[]; };
layout(set = 1, binding = VOLUME_HARMONICS, std430) readonly buffer Harmonics { float harmonics[]; };
layout(set = 1, binding = VOLUME_GLOSSY, std430) readonly buffer Glossy { float glossy[]; };

#include "shaders/shared/volume_grids.glsl"

const float kMinWeight = 1e-6; // as cache_grids.cpp

/// Up to eight texels of a map and their weights: lookUpGlossy().
struct GlossyLookup {
    uint texel[8];
    float weight[8];
    uint count, texels; // in all levels of a map
};

GlossyLookup lookUpGlossy(PackedSurface s) {
    GlossyLookup found;
    found.count = 0u;
    const vec3 local = s.detailNormal * glossyFrame(volume.eye - s.position);
    const uint levels = glossyLevels(volume.tile);
    found.texels = glossyFirstTexel(volume.tile, levels);
    if (!(local.z > 0.0))
        return found;
    const vec2 p = squareOfHemisphere(local);
    const float squared = s.roughness * s.roughness;
    const float exponent = 2.0 / (squared * squared + 0.0005);
    const float level =
        clamp(0.5 * log2(float(volume.tile * volume.tile) / (1.0 + exponent)), 0.0, float(levels - 1u));
    const uint fine = min(uint(level), levels - 1u);
    for (uint k = 0u; k < 2u; ++k) {
        const float share = k == 0u ? 1.0 - (level - float(fine)) : level - float(fine);
        if (!(share > 0.0))
            continue;
        const uint side = volume.tile >> (fine + k), first = glossyFirstTexel(volume.tile, fine + k);
        const vec2 q = clamp(p * float(side) - 0.5, vec2(0), vec2(side - 1u));
        const uvec2 c = uvec2(q), next = min(c + 1u, uvec2(side - 1u));
        const vec2 f = q - vec2(c);
        for (uint i = 0u; i < 4u; ++i) {
            const uvec2 corner = uvec2((i & 1u) == 0u ? c.x : next.x, i < 2u ? c.y : next.y);
            found.texel[found.count] = first + corner.y * side + corner.x;
            found.weight[found.count++] =
                share * ((i & 1u) == 0u ? 1.0 - f.x : f.x) * (i < 2u ? 1.0 - f.y : f.y);
        }
    }
    return found;
}

struct CacheSums {
    vec3 irradiance, lobe;
};

/// What surfaces receive of one cache.
CacheSums readCache(uint cache, float irradiance[kCoefficients], float lobe[kCoefficients], GlossyLookup texels) {
    CacheSums sums = CacheSums(vec3(0), vec3(0));
    [[unroll]] for (uint i = 0u; i < kCoefficients; ++i) {
        const uint place = 3u * (cache * kCoefficients + i);
        const vec3 c = vec3(harmonics[place], harmonics[place + 1u], harmonics[place + 2u]);
        sums.irradiance += irradiance[i] * c;
        sums.lobe += lobe[i] * c;
    }
    if (volume.clamped == 1u)
        sums.irradiance = max(sums.irradiance, 0.0);
    if (volume.tile > 0u && kView == VIEW_LIT) {
        sums.lobe = vec3(0);
        for (uint t = 0u; t < texels.count; ++t) {
            const uint place = 3u * (cache * texels.texels + texels.texel[t]);
            sums.lobe += texels.weight[t] * vec3(glossy[place], glossy[place + 1u], glossy[place + 2u]);
        }
    }
    return sums;
}

/// Adds the caches about p in one grid, whose weights are scaled up to `share`. False if there are none.
bool addCorners(uint g, vec3 p, float share, float irradiance[kCoefficients], float lobe[kCoefficients],
                GlossyLookup texels, inout CacheSums sums) {
    const uvec3 cell = cellAt(g, p);
    const vec3 f = clamp((p - nodePlace(g, cell)) / volume.grid[g].cell, 0.0, 1.0);
    CacheSums mine = CacheSums(vec3(0), vec3(0));
    float sum = 0.0;
    for (uint k = 0u; k < 8u; ++k) {
        const uint cache = address[nodeIndex(g, cellCorner(cell, k))];
        const vec3 w = mix(1.0 - f, f, vec3(k & 1u, k >> 1 & 1u, k >> 2));
        const float weight = w.x * w.y * w.z;
        if (cache == VOLUME_NO_CACHE || !(weight > 0.0))
            continue;
        const CacheSums c = readCache(cache, irradiance, lobe, texels);
        mine.irradiance += weight * c.irradiance;
        mine.lobe += weight * c.lobe;
        sum += weight;
    }
    if (sum < kMinWeight)
        return false;
    sums.irradiance += mine.irradiance * (share / sum);
    sums.lobe += mine.lobe * (share / sum);
    return true;
}

/// Irradiance, and mean radiance in the reflected lobe: lookUpCaches().
CacheSums readCaches(PackedSurface s, vec3 axis, float factors[8]) {
    float irradiance[kCoefficients], lobe[kCoefficients];
    irradianceWeights(s.detailNormal, irradiance);
    lobeWeights(axis, factors, lobe);
    GlossyLookup texels;
    texels.count = 0u;
    if (volume.tile > 0u && kView == VIEW_LIT)
        texels = lookUpGlossy(s);
    CacheSums sums = CacheSums(vec3(0), vec3(0));
    const vec3 p = aboveSurface(s.position, s.geometricNormal);
    const GridShares shares = gridShares(p);
    float found = 0.0;
    uint next = 0u; // a grid that takes another's place is not asked twice
    for (uint k = 0u; k < 2u; ++k) {
        const float share = k == 0u ? shares.weight : 1.0 - shares.weight;
        if (!(share > 0.0))
            continue;
        for (uint g = max(shares.grid + k, next); g < volume.count; ++g) {
            next = g + 1u;
            if (addCorners(g, p, share, irradiance, lobe, texels, sums)) {
                found += share;
                break;
            }
        }
    }
    const float scale = found > 0.0 ? 1.0 / found : 0.0;
    return CacheSums(max(sums.irradiance * scale, 0.0), max(sums.lobe * scale, 0.0));
}

void main() {
    PackedSurface s;
    outColor = vec4(0);
    if (!litSurface(s))
        return;
    const float NoV = clamp(dot(s.detailNormal, s.toEye), 0.0, 1.0);
    ReflectionLobe reflection = reflectionLobe(reflectionTable, s.roughness, NoV, kBands);
    windowFactors(reflection.factors);
    const vec3 axis = normalize(reflection.towards.x * s.detailNormal +
                                reflection.towards.y * reflect(-s.toEye, s.detailNormal));
    const CacheSums light = readCaches(s, axis, reflection.factors);
    writeLight(s, light.irradiance, (s.F0 * reflection.share.x + reflection.share.y) * light.lobe);
}
