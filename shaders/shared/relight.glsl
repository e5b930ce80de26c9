// SPDX-License-Identifier: MIT
// Shared by the steps of relighting: which item an invocation processes.
#include "shaders/shared/gpu_relight.h"

layout(constant_id = 0) const uint kLanes = 32;
layout(local_size_x_id = 0) in;

layout(push_constant) uniform Push {
    GpuRelightRange range;
};

/// Index of the workgroup. Workgroups are arranged in rows, because a dispatch may be at most 65535 wide; the last row
/// may contain surplus ones.
uint groupIndex() {
    return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}

/// Index of the invocation's item; there are no items from range.end on.
uint itemIndex() {
    return range.begin + groupIndex() * kLanes + gl_LocalInvocationIndex;
}
