// SPDX-License-Identifier: MIT
// Gathers the probes into a block of receivers [range.begin, range.end): E = max(0, sum of T P), a receiver per lane.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/sparse.glsl"
#include "shaders/shared/sparse_cache.glsl"

layout(std430, binding = SPARSE_NEAR) readonly buffer Near { uvec4 nearProbes[]; };
// Of the block: all receivers' first pair before their second one, so that neighbouring lanes read neighbouring words.
layout(std430, binding = SPARSE_TRANSPORT) readonly buffer Transport { uint transport[]; };
layout(std430, binding = SPARSE_IRRADIANCE) writeonly buffer Irradiance { vec4 irradiance[]; };

void main() {
    cacheProbes();
    const uint r = itemIndex();
    if (r >= range.end)
        return;
    const uint count = range.end - range.begin;
    const uvec4 near = nearProbes[r];
    uint word = r - range.begin;
    vec3 E = vec3(0);
    for (uint k = 0; k < SPARSE_PROBES_PER_RECEIVER; ++k) {
        const uint row = bitfieldExtract(near[k / 2], int(k % 2) * 16, 16) * kRow;
        vec3 part = vec3(0);
        for (uint pair = 0; pair < kPairs; ++pair, word += count) {
            const vec2 t = unpackHalf2x16(transport[word]);
            part += t.x * harmonic(row + 2 * pair) + t.y * harmonic(row + 2 * pair + 1);
        }
        E += range.clampParts != 0 ? max(part, 0.0) : part;
    }
    irradiance[r] = vec4(max(E, 0.0), 0);
}
