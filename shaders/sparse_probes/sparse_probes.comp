// SPDX-License-Identifier: MIT
// Lights the probes, one workgroup each: P = sky + (4 pi / Q) times the sum over relight rays of the radiance of what
// they hit and the harmonics of their direction. Each lane sums one coefficient over a slice of the rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/sparse.glsl"

layout(constant_id = 2) const uint kRays = 800;

layout(std430, binding = SPARSE_RADIANCE) readonly buffer Radiance { vec4 radiance[]; };
layout(std430, binding = SPARSE_HITS) readonly buffer Hits { uint hits[]; };
layout(std430, binding = SPARSE_BASIS) readonly buffer Basis { float basis[]; };
layout(std430, binding = SPARSE_SKY) readonly buffer Sky { vec4 sky[]; };
layout(std430, binding = SPARSE_PROBES) writeonly buffer Probes { vec4 probes[]; };

const uint kSlices = kLanes / kCoefficients; // there are at least as many lanes as coefficients

shared vec3 sent[kLanes]; // by what a batch of rays hits
shared vec3 sums[kLanes];

void main() {
    const uint probe = range.begin + groupIndex();
    if (probe >= range.end)
        return;
    const uint lane = gl_LocalInvocationIndex, i = lane % kCoefficients, slice = lane / kCoefficients;
    vec3 sum = vec3(0);
    for (uint base = 0; base < kRays; base += kLanes) {
        const uint count = min(kLanes, kRays - base);
        vec3 L = vec3(0);
        if (lane < count) {
            const uint hit = hits[probe * kRays + base + lane];
            if (hit < SPARSE_DARK_HIT)
                L = radiance[hit].rgb;
        }
        barrier();
        sent[lane] = L;
        barrier();
        if (slice < kSlices)
            for (uint q = slice; q < count; q += kSlices)
                sum += sent[q] * basis[(base + q) * kCoefficients + i];
    }
    sums[lane] = sum;
    barrier();
    if (lane >= kCoefficients)
        return;
    const float solidAngle = 4.0 * 3.14159265358979 / float(kRays);
    vec3 total = vec3(0);
    for (uint s = 0; s < kSlices; ++s)
        total += sums[s * kCoefficients + lane];
    probes[probe * kRow + lane] = vec4(sky[probe * kRow + lane].rgb + total * solidAngle, 0);
}
