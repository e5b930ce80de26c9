// SPDX-License-Identifier: MIT
// Read by C++ and GLSL.
#ifndef SHADERS_SHARED_GPU_POINT_IRRADIANCE_H
#define SHADERS_SHARED_GPU_POINT_IRRADIANCE_H

#ifdef __cplusplus
#include <cstdint>
namespace limn::shared {
using uint = std::uint32_t;
#endif

// clang-format off
/// Push constants of point_irradiance.comp.
struct GpuPointLighting {
    uint count;                               // irradiances
    uint lights; float normalBias, lightBias; // as ShadowedLights
    uint keptLights, freshLights;             // as KeptLights
    uint workBegin, workEnd;                  // range of the fresh lights and then those without a place; 0 starts the sums, the end completes them
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuPointLighting) == 32);
} // namespace limn::shared
#endif

#endif
