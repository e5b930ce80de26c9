// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_LPV_MAP_H
#define SHADERS_SHARED_GPU_LPV_MAP_H

#include "shaders/shared/gpu_rsm.h"

#ifdef __cplusplus
namespace limn::shared {
using glm::uvec3;
#endif

// Bindings of set 0 after those of the map
#define LPV_MAP_SUMS 3u  // 12 integers per cell: a lobe of each colour, as gpu_lpv.h orders it
#define LPV_MAP_COUNT 4u // cells that something was sent into
#define LPV_MAP_LOBES 5u // GpuCellLobe of each of them
#define LPV_MAP_BINDINGS 6u

#define LPV_MAP_LANES 8 // of a group along each side of a map

// clang-format off
/// A view of a light's map, and the lattice that its texels are sent into.
struct GpuLpvMap {
    GpuRsmView view;
    vec3 lower; float cell;  // m
    uvec3 size; float scale; // cells; integers per unit of a lobe
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuLpvMap) == 128);
} // namespace limn::shared
#endif

#endif
