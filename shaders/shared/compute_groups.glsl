// SPDX-License-Identifier: MIT
// The workgroups of compute shaders: kLanes invocations each, in rows.

layout(constant_id = 0) const uint kLanes = 32;
layout(local_size_x_id = 0) in;

/// Index of the workgroup. Workgroups are arranged in rows, because a dispatch may be at most 65535 wide; the last row
/// may contain surplus ones.
uint groupIndex() {
    return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}
