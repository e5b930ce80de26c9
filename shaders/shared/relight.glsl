// SPDX-License-Identifier: MIT
// What the steps of relighting share: which of many things an invocation works on.
#include "shaders/shared/gpu_relight.h"

layout(constant_id = 0) const uint kLanes = 32;
layout(local_size_x_id = 0) in;

layout(push_constant) uniform Push {
    GpuRelightRange range;
};

/// Groups lie in rows: a dispatch may be no wider than 65535. The last row may hold groups too many.
uint groupIndex() {
    return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}

/// One thing per invocation; past range.end there is nothing.
uint itemIndex() {
    return range.begin + groupIndex() * kLanes + gl_LocalInvocationIndex;
}
