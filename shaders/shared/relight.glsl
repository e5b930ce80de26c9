// SPDX-License-Identifier: MIT
// Shared by the steps of relighting: which item an invocation processes.
#include "shaders/shared/compute_groups.glsl"
#include "shaders/shared/gpu_relight.h"

layout(push_constant) uniform Push {
    GpuRelightRange range;
};

/// Index of the invocation's item; there are no items from range.end on.
uint itemIndex() {
    return range.begin + groupIndex() * kLanes + gl_LocalInvocationIndex;
}
