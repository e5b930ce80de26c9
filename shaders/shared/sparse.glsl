// SPDX-License-Identifier: MIT
// Shared by the steps of sparse probes.
#include "shaders/shared/compute_groups.glsl"
#include "shaders/shared/gpu_sparse.h"

layout(constant_id = 1) const uint kCoefficients = 16; // of a probe, [1, 64]

const uint kPairs = (kCoefficients + 1) / 2;
const uint kRow = 2 * kPairs; // values of a probe; the last is 0 where their number is odd

layout(push_constant) uniform Push {
    GpuSparseRange range;
};

/// Index of the invocation's item; there are no items from range.end on.
uint itemIndex() {
    return range.begin + groupIndex() * kLanes + gl_LocalInvocationIndex;
}
