// SPDX-License-Identifier: MIT
// Computes the SH of incident radiance of the caches order[range.begin, range.end), one workgroup per cache, whose
// links are distributed over the lanes. From band kChromaBands on the light is grey, and only its luma is summed.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/horizon.h"
#include "shaders/shared/relight.glsl"
#include "shaders/shared/sh_bands.glsl"

layout(constant_id = 2) const int kChromaBands = 3; // [1, kBands]
layout(constant_id = 3) const uint kStorage = RELIGHT_STORAGE_RTP;
layout(constant_id = 4) const int kStoredBands = 3; // of links that hold harmonics: kBands or more

layout(std430, binding = RELIGHT_RADIOSITY) readonly buffer Radiosity { vec4 radiosity[]; };
layout(std430, binding = RELIGHT_CACHES) readonly buffer Caches { GpuCache caches[]; };
layout(std430, binding = RELIGHT_LINKS) readonly buffer Links { uint links[]; };
layout(std430, binding = RELIGHT_ORDER) readonly buffer Order { uint order[]; };
layout(std430, binding = RELIGHT_SH) writeonly buffer Sh { vec4 sh[]; };

const bool kAllColoured = kChromaBands == kBands;
const int kColoured = kChromaBands * kChromaBands;
// Red or luma of all coefficients, then green or Co, then blue or Cg of the coloured ones.
const int kSums = kCoefficients + 2 * kColoured;

// Number of sums that are added up over the lanes at once; shared memory is limited.
const int kSlice = kSums < 63 ? kSums : 63;

shared float slice[kLanes * (kSlice | 1)]; // a row per lane; odd, so that columns fall into different banks
shared float total[kSums];

vec3 toYCoCg(vec3 c) {
    const float sides = (c.r + c.b) * 0.25, middle = c.g * 0.5;
    return vec3(middle + sides, (c.r - c.b) * 0.5, middle - sides);
}

vec3 toRgb(vec3 c) {
    return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z);
}

float unpackSnorm(uint bits) {
    return float(bitfieldExtract(int(bits), 0, 16)) * (1.0 / 32767.0);
}

vec3 unpackOct(uint packed) {
    const float x = unpackSnorm(packed), y = unpackSnorm(packed >> 16);
    const float z = 1.0 - abs(x) - abs(y), fold = max(-z, 0.0);
    return normalize(vec3(x - (x < 0.0 ? -fold : fold), y - (y < 0.0 ? -fold : fold), z));
}

/// Computes the contribution of the link's node at radiosity 1, to be multiplied by the cache's scale. Returns the
/// node.
uint expandCone(uint link, out float basis[kCoefficients]) {
    const uint at = link * RELIGHT_CONE_WORDS;
    const vec2 uTransport = unpackHalf2x16(links[at + 2]);
    float cone[kBands];
    shBasis(unpackOct(links[at + 1]), basis);
    coneFactors(uTransport.x, cone);
    [[unroll]] for (int l = 0; l < kBands; ++l)
        [[unroll]] for (int k = 0; k < 2 * kBands - 1; ++k)
            if (k <= 2 * l)
                basis[l * l + k] *= uTransport.y * cone[l];
    return links[at];
}

uint readHarmonics(uint link, out float basis[kCoefficients]) {
    const uint at = link * (1 + (kStoredBands * kStoredBands + 1) / 2);
    [[unroll]] for (int i = 0; i < kCoefficients; i += 2) {
        const vec2 pair = unpackHalf2x16(links[at + 1 + i / 2]);
        basis[i] = pair.x;
        if (i + 1 < kCoefficients)
            basis[i + 1] = pair.y;
    }
    return links[at];
}

/// The sums of this lane's links.
void sumLinks(GpuCache cache, out float sums[kSums]) {
    [[unroll]] for (int i = 0; i < kSums; ++i)
        sums[i] = 0.0;
    for (uint link = cache.linkBegin + gl_LocalInvocationIndex; link < cache.linkEnd; link += kLanes) {
        float basis[kCoefficients];
        uint node;
        if (kStorage == RELIGHT_STORAGE_RTP)
            node = expandCone(link, basis);
        else
            node = readHarmonics(link, basis);
        vec3 from = radiosity[node].rgb;
        if (!kAllColoured)
            from = toYCoCg(from);
        [[unroll]] for (int i = 0; i < kCoefficients; ++i) {
            sums[i] += from.x * basis[i];
            if (i < kColoured) {
                sums[kCoefficients + i] += from.y * basis[i];
                sums[kCoefficients + kColoured + i] += from.z * basis[i];
            }
        }
    }
}

/// Adds the lanes' sums up into `total`, lane after lane, so that the same light gives the same bits.
void addLanes(float sums[kSums]) {
    const uint lane = gl_LocalInvocationIndex, row = kSlice | 1;
    [[unroll]] for (int begin = 0; begin < kSums; begin += kSlice) {
        [[unroll]] for (int i = 0; i < kSlice; ++i)
            if (begin + i < kSums)
                slice[lane * row + i] = sums[begin + i];
        barrier();
        for (uint i = lane; i < kSlice && begin + i < kSums; i += kLanes) {
            float sum = 0.0;
            for (uint k = 0; k < kLanes; ++k)
                sum += slice[k * row + i];
            total[begin + i] = sum;
        }
        barrier();
    }
}

/// The sum of coefficient i, in the colours in which links are summed.
vec3 totalOf(int i) {
    return i < kColoured
               ? vec3(total[i], total[kCoefficients + i], total[kCoefficients + kColoured + i])
               : vec3(total[i], 0, 0);
}

/// What is added to coefficient i < 4 so that light continues below the surface: continueBelow() of engine/math/horizon.h.
vec3 belowSurface(int i, vec3 n) {
    const vec3 below = HORIZON_C0 * totalOf(0) + HORIZON_C1 * (n.y * totalOf(1) + n.z * totalOf(2) + n.x * totalOf(3));
    return below * (i == 0 ? BELOW_C0 : -BELOW_C1 * (i == 1 ? n.y : i == 2 ? n.z : n.x));
}

void main() {
    const uint k = range.begin + groupIndex();
    if (k >= range.end)
        return;
    const uint c = order[k];
    const GpuCache cache = caches[c];
    float sums[kSums];
    sumLinks(cache, sums);
    addLanes(sums);
    const bool ofSurface = dot(cache.normal, cache.normal) > 0.0;
    for (int i = int(gl_LocalInvocationIndex); i < kCoefficients; i += int(kLanes)) {
        vec3 v = totalOf(i);
        if (ofSurface && i < 4)
            v += belowSurface(i, cache.normal);
        sh[c * kCoefficients + i] = vec4((kAllColoured ? v : toRgb(v)) * cache.scale, 0);
    }
}
