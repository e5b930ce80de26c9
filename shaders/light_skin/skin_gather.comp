// SPDX-License-Identifier: MIT
// Sums what a cache receives of the chosen virtual lights, a workgroup a cache, as gatherLight() of
// engine/techniques/light_skin/gather_light.cpp. Lanes are added in a fixed order, so that repeats are equal.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/compute_groups.glsl"
#include "shaders/shared/gpu_skin_steps.h"

layout(push_constant) uniform Push { GpuSkinStep step; };
layout(std430, binding = SKIN_STEP_CHOSEN) readonly buffer Chosen { GpuChosenLight chosen[]; };
layout(std430, binding = SKIN_STEP_CACHES) readonly buffer Caches { GpuGatheringCache caches[]; };
layout(std430, binding = SKIN_STEP_RECEIVED) buffer Received { float received[]; };

const float kPi = 3.14159265358979;

shared float lanes[SKIN_SUMS][kLanes];

struct Sums {
    vec3 light;
    float weight;
    vec3 first, second;
};

void addTo(inout Sums sums, vec3 flux, float transfer, float weight, vec3 way) {
    sums.light += flux * transfer;
    sums.weight += weight;
    sums.first += weight * way;
    sums.second += weight * way * way;
}

void share(uint lane, uint base, Sums sums) {
    for (uint k = 0u; k < 3u; ++k) {
        lanes[base + k][lane] = sums.light[k];
        lanes[base + 4u + k][lane] = sums.first[k];
        lanes[base + 7u + k][lane] = sums.second[k];
    }
    lanes[base + 3u][lane] = sums.weight;
}

void main() {
    const uint c = groupIndex(), lane = gl_LocalInvocationID.x;
    if (c >= step.caches)
        return;
    const GpuGatheringCache cache = caches[c];
    const vec3 seen = cache.position - step.eye;
    const float distance = length(seen);
    const vec3 mirrored = distance > 0.0 ? reflect(seen / distance, cache.normal) : cache.normal;
    const bool glosses = cache.exponent > 0.0;
    Sums diffuse = Sums(vec3(0), 0.0, vec3(0), vec3(0)), glossy = diffuse;
    for (uint i = lane; i < step.count; i += kLanes) {
        const GpuChosenLight light = chosen[i];
        const vec3 way = light.position - cache.position;
        const float r2 = max(dot(way, way), 1e-18);
        const float transfer = max(-dot(light.normal, way), 0.0) * max(dot(cache.normal, way), 0.0) /
                               (r2 * (light.area + kPi * r2));
        addTo(diffuse, light.flux, transfer, light.weight * light.area * (step.epsilon + transfer), way);
        if (!glosses)
            continue;
        const float along = max(dot(way, mirrored), 0.0);
        const float lobe = pow(min(along * along / r2, 1.0), cache.exponent / 2.0) * transfer;
        addTo(glossy, light.flux, lobe, light.weight * light.area * (step.epsilon + lobe), way);
    }
    glossy.light *= (cache.exponent + 2.0) / (2.0 * kPi);
    if (!glosses)
        glossy = Sums(vec3(0), 0.0, vec3(0), vec3(0));
    share(lane, 0u, diffuse);
    share(lane, 10u, glossy);
    barrier();
    for (uint k = lane; k < SKIN_SUMS; k += kLanes) {
        float sum = step.add == 1u ? received[SKIN_SUMS * c + k] : 0.0;
        for (uint j = 0u; j < kLanes; ++j)
            sum += lanes[k][j];
        received[SKIN_SUMS * c + k] = sum;
    }
}
