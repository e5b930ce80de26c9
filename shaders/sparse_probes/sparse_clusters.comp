// SPDX-License-Identifier: MIT
// Gathers the probes into the receivers of clusters whose transport is a product of two matrices, T = L R: a workgroup
// computes R P once and then E = max(0, L (R P)) of each of its cluster's receivers.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/sparse.glsl"
#include "shaders/shared/sparse_cache.glsl"

layout(std430, binding = SPARSE_NEAR) readonly buffer Clusters { GpuCluster clusters[]; };
layout(std430, binding = SPARSE_TRANSPORT) readonly buffer Words { uint words[]; };
layout(std430, binding = SPARSE_IRRADIANCE) writeonly buffer Irradiance { vec4 irradiance[]; };

const uint kReceiversPerLane = (SPARSE_CLUSTER_RECEIVERS + kLanes - 1) / kLanes;

shared vec3 parts[kLanes];
shared vec3 components[SPARSE_CLUSTER_RECEIVERS + 1]; // of R P; a 0 follows the last one

/// Computes the components of what the probes [first, end) of the cluster see. Lanes share the columns of R.
void multiplyRight(GpuCluster c, uint first, uint end) {
    const uint lane = gl_LocalInvocationIndex, columns = (end - first) * kPairs;
    for (uint base = 0; base < c.rank; base += kLanes) {
        const uint width = min(kLanes, c.rank - base), slices = kLanes / width;
        const uint k = base + lane % width;
        vec3 sum = vec3(0);
        if (lane / width < slices)
            for (uint column = lane / width; column < columns; column += slices) {
                const uint probe = first + column / kPairs, pair = column % kPairs;
                const vec2 t = unpackHalf2x16(words[c.right + (probe * kPairs + pair) * c.rank + k]);
                const uint at = words[c.probes + probe] * kRow + 2 * pair;
                sum += t.x * harmonic(at) + t.y * harmonic(at + 1);
            }
        parts[lane] = sum;
        barrier();
        if (lane < width) {
            vec3 total = vec3(0);
            for (uint s = 0; s < slices; ++s)
                total += parts[s * width + lane];
            components[base + lane] = total;
        }
        barrier();
    }
}

/// Irradiance of one of the cluster's receivers.
vec3 multiplyLeft(GpuCluster c, uint receiver) {
    vec3 sum = vec3(0);
    for (uint pair = 0; pair < (c.rank + 1) / 2; ++pair) {
        const vec2 t = unpackHalf2x16(words[c.left + pair * c.receiverCount + receiver]);
        sum += t.x * components[2 * pair] + t.y * components[2 * pair + 1];
    }
    return sum;
}

void main() {
    const uint index = range.begin + groupIndex();
    if (index >= range.end)
        return;
    cacheProbes();
    const GpuCluster c = clusters[index];
    const uint lane = gl_LocalInvocationIndex;
    if (lane == 0)
        components[c.rank] = vec3(0);
    vec3 E[kReceiversPerLane];
    for (uint k = 0; k < kReceiversPerLane; ++k)
        E[k] = vec3(0);
    const uint step = range.clampParts != 0 ? 1 : max(c.probeCount, 1);
    for (uint first = 0; first < c.probeCount; first += step) {
        multiplyRight(c, first, first + step);
        for (uint k = 0; k < kReceiversPerLane; ++k) {
            const uint receiver = lane + k * kLanes;
            if (receiver >= c.receiverCount)
                continue;
            const vec3 part = multiplyLeft(c, receiver);
            E[k] += range.clampParts != 0 ? max(part, 0.0) : part;
        }
        barrier();
    }
    for (uint k = 0; k < kReceiversPerLane; ++k) {
        const uint receiver = lane + k * kLanes;
        if (receiver < c.receiverCount)
            irradiance[words[c.receivers + receiver]] = vec4(max(E[k], 0.0), 0);
    }
}
