// SPDX-License-Identifier: MIT
// Projects what the probes of a block see onto three bands of harmonics, a workgroup per probe: surfaces that reflect
// direct light and, where light bounces more than once, the probes' own light of the bounce before; what they emit; and
// the sky.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/compute_groups.glsl"
#include "shaders/shared/gpu_probes.h"

const float kPi = 3.14159265358979;
#define SH_BANDS_CONSTANT 2
#include "shaders/shared/sh_bands.glsl"
#include "shaders/shared/sh_field.glsl"

layout(constant_id = 1) const uint kTexels = 2304; // of a map

layout(std430, binding = PROBE_HITS) readonly buffer Hits { GpuProbeHit hits[]; };
layout(std430, binding = PROBE_DIRECT) readonly buffer Direct { vec4 direct[]; };
layout(std430, binding = PROBE_SKY) readonly buffer Sky { vec4 sky[]; };
layout(std430, binding = PROBE_BASIS) readonly buffer Basis { float basis[]; };
layout(std430, binding = PROBE_BEFORE) readonly buffer Before { vec4 before[]; };
layout(std430, binding = PROBE_LIGHT) writeonly buffer Light { vec4 light[]; };
layout(std430, binding = PROBE_MEANS) writeonly buffer Means { vec4 means[]; };
layout(std430, binding = PROBE_MOMENTS) readonly buffer Moments { uint gridDepth[]; };

layout(std430, binding = PROBE_RADIANCE) writeonly buffer Radiance { float radiance[]; };

layout(push_constant) uniform Push {
    GpuProbeRange range;
};

#include "shaders/shared/grid_depth.glsl"
#include "shaders/shared/grid_moments.glsl"

shared vec3 sums[kLanes * PROBE_COEFFICIENTS];

/// Irradiance at a surface point from the eight probes around it: sampleIrradiance() of engine/field/sample_field.h.
vec3 bouncedIrradiance(vec3 position, vec3 normal) {
    const bool smoothWeights = range.weights == GRID_SMOOTH_MOMENTS;
    const ivec3 last = ivec3(range.gridSize) - 1;
    const vec3 x = clamp((position - range.gridLower) / range.cellSize - 0.5, vec3(0), vec3(last));
    const ivec3 lower = min(ivec3(x), max(last - 1, 0));
    const vec3 f = x - vec3(lower);
    const float bias = GRID_DEPTH_BIAS * min(range.cellSize.x, min(range.cellSize.y, range.cellSize.z));
    const vec3 from = smoothWeights ? position + normal * bias : position;
    float w[kCoefficients];
    irradianceWeights(normal, w);
    vec3 E = vec3(0);
    float sum = 0.0;
    for (int k = 0; k < 8; ++k) {
        const ivec3 high = ivec3(k & 1, (k >> 1) & 1, k >> 2);
        const ivec3 cell = min(lower + high, last);
        const vec3 share = mix(1.0 - f, f, vec3(high));
        const uint probe = (uint(cell.z) * range.gridSize.y + uint(cell.y)) * range.gridSize.x + uint(cell.x);
        const vec3 centre = range.gridLower + (vec3(cell) + 0.5) * range.cellSize;
        const float weight =
            share.x * share.y * share.z * momentsWeight(probe, from - centre, normal, smoothWeights);
        sum += weight;
        for (uint i = 0; i < PROBE_COEFFICIENTS; ++i)
            E += weight * w[i] * before[probe * PROBE_COEFFICIENTS + i].rgb;
    }
    return sum > 0.0 ? max(E / sum, 0.0) : vec3(0);
}

/// Radiance that arrives from the direction of a texel.
vec3 seen(uint texel, uint index) {
    const GpuProbeHit hit = hits[index];
    if (hit.kind == PROBE_SEES_SKY)
        return sky[texel].rgb;
    if (hit.kind != PROBE_SEES_SURFACE)
        return vec3(0);
    vec3 E = direct[index].rgb;
    if (range.weights != GRID_PLAIN)
        E += bouncedIrradiance(hit.position, hit.normal);
    const vec3 albedo = vec3(unpackUnorm2x16(hit.albedoRedGreen), unpackUnorm2x16(hit.albedoBlue).x);
    return albedo / kPi * E + hit.emission;
}

void main() {
    const uint probe = range.begin + groupIndex();
    if (probe >= range.end)
        return;
    const uint lane = gl_LocalInvocationIndex;
    vec3 mine[PROBE_COEFFICIENTS];
    for (uint i = 0; i < PROBE_COEFFICIENTS; ++i)
        mine[i] = vec3(0);
    for (uint texel = lane; texel < kTexels; texel += kLanes) {
        const vec3 L = seen(texel, groupIndex() * kTexels + texel);
        if (range.marched != 0u)
            for (uint c = 0; c < 3u; ++c)
                radiance[3u * (probe * kTexels + texel) + c] = L[c];
        for (uint i = 0; i < PROBE_COEFFICIENTS; ++i)
            mine[i] += L * basis[texel * PROBE_COEFFICIENTS + i];
    }
    for (uint i = 0; i < PROBE_COEFFICIENTS; ++i)
        sums[i * kLanes + lane] = mine[i];
    barrier();
    for (uint i = lane; i < PROBE_COEFFICIENTS; i += kLanes) { // lane after lane: the same light gives the same bits
        vec3 total = vec3(0);
        for (uint k = 0; k < kLanes; ++k)
            total += sums[i * kLanes + k];
        light[probe * PROBE_COEFFICIENTS + i] = vec4(total, 0);
        if (i == 0)
            means[probe] = vec4(total, 0);
    }
}
