// SPDX-License-Identifier: MIT
// A step of light propagation volumes in which each invocation handles one cell.
#include "shaders/shared/lpv.glsl"

layout(local_size_x = LPV_GROUP_X, local_size_y = LPV_GROUP_Y, local_size_z = LPV_GROUP_Z) in;

bool isInside(uvec3 cell) {
    return all(lessThan(cell, lattice.size));
}
