// SPDX-License-Identifier: MIT
// Shared by the steps that send a light's map into a lattice.
#include "shaders/shared/gpu_lpv.h"
#include "shaders/shared/gpu_lpv_map.h"

layout(push_constant) uniform Push {
    GpuLpvMap map;
};
