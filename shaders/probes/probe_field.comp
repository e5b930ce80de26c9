// SPDX-License-Identifier: MIT
// Writes the light of probes into the grid that the viewport samples, a probe per lane, in layers of four values as
// engine/field/field_packing.h says; all three bands are in colour.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/compute_groups.glsl"
#include "shaders/shared/field_value.glsl"
#include "shaders/shared/gpu_probes.h"

layout(std430, binding = PROBE_LIGHT) readonly buffer Light { vec4 light[]; };
layout(std430, binding = PROBE_GRID) writeonly buffer Grid { uvec2 grid[]; };

layout(push_constant) uniform Push {
    GpuProbeRange range;
};

const uint kValues = 3 * PROBE_COEFFICIENTS;
const uint kLayers = (kValues + 3) / 4;

float valueOf(uint probe, uint v) {
    return v < kValues ? fieldValue(light[probe * PROBE_COEFFICIENTS + v / 3][v % 3] * range.fieldScale) : 0.0;
}

void main() {
    const uint probe = groupIndex() * kLanes + gl_LocalInvocationIndex;
    if (probe >= range.end)
        return;
    for (uint layer = 0; layer < kLayers; ++layer)
        grid[layer * range.end + probe] =
            uvec2(packHalf2x16(vec2(valueOf(probe, 4 * layer), valueOf(probe, 4 * layer + 1))),
                  packHalf2x16(vec2(valueOf(probe, 4 * layer + 2), valueOf(probe, 4 * layer + 3))));
}
