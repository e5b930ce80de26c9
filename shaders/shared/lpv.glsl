// SPDX-License-Identifier: MIT
// Shared by the steps of light propagation volumes that know nothing of maps.
#include "shaders/shared/gpu_lpv.h"
#include "shaders/shared/lpv_volume.glsl"

layout(push_constant) uniform Push {
    GpuLpvStep lattice;
};
