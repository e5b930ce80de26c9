// SPDX-License-Identifier: MIT
// Writes a level of the probes' radiance, a texel per lane, from the finer one: updateLevels() of
// engine/techniques/probes/marched_maps.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/compute_groups.glsl"
#include "shaders/shared/gpu_probes.h"

layout(constant_id = 1) const uint kTexels = 2304; // of a map

layout(std430, binding = PROBE_RADIANCE) buffer Radiance { float radiance[]; };

layout(push_constant) uniform Push {
    GpuProbeRange range;
};

/// A texel's share of the texels of the finer level along an axis: sharesOf() of marched_maps.cpp.
struct TexelShare {
    uint first, count;
    float weight[3];
};

TexelShare sharesOf(uint texel, uint fine, uint coarse) {
    const float ratio = float(fine) / float(coarse), from = float(texel) * ratio, to = from + ratio;
    TexelShare share = TexelShare(min(uint(from + 1e-4), fine - 1u), 0u, float[](0.0, 0.0, 0.0));
    for (uint k = 0u; k < 3u && share.first + k < fine; ++k) {
        const float at = float(share.first + k), covered = min(to, at + 1.0) - max(from, at);
        if (covered < 1e-4)
            break;
        share.weight[share.count++] = covered / ratio;
    }
    return share;
}

void main() {
    uint fine = uint(sqrt(float(kTexels)) + 0.5), from = 0u; // side of the finer level, and its first texel
    for (uint k = 1u; k < range.marched; ++k) {
        from += range.end * fine * fine;
        fine = (fine + 1u) / 2u;
    }
    const uint coarse = (fine + 1u) / 2u, to = from + range.end * fine * fine;
    const uint index = groupIndex() * kLanes + gl_LocalInvocationIndex;
    if (index >= range.end * coarse * coarse)
        return;
    const uint probe = index / (coarse * coarse), texel = index % (coarse * coarse);
    const TexelShare rows = sharesOf(texel / coarse, fine, coarse), columns = sharesOf(texel % coarse, fine, coarse);
    vec3 sum = vec3(0);
    for (uint j = 0u; j < rows.count; ++j)
        for (uint i = 0u; i < columns.count; ++i) {
            const uint at = 3u * (from + (probe * fine + rows.first + j) * fine + columns.first + i);
            sum += rows.weight[j] * columns.weight[i] * vec3(radiance[at], radiance[at + 1u], radiance[at + 2u]);
        }
    for (uint c = 0u; c < 3u; ++c)
        radiance[3u * (to + index) + c] = sum[c];
}
