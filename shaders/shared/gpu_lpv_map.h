// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_LPV_MAP_H
#define SHADERS_SHARED_GPU_LPV_MAP_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
namespace limn::shared {
using glm::uvec3;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
#endif

// Bindings of set 0
#define LPV_MAP_ALBEDO 0u
#define LPV_MAP_SURFACE 1u
#define LPV_MAP_DEPTH 2u
#define LPV_MAP_SUMS 3u  // 12 integers per cell: a lobe of each colour, as gpu_lpv.h orders it
#define LPV_MAP_COUNT 4u // cells that something was sent into
#define LPV_MAP_LOBES 5u // GpuCellLobe of each of them
#define LPV_MAP_BINDINGS 6u

#define LPV_MAP_LANES 8 // of a group along each side of a map

#define LPV_LIGHT_SUN 0u // as limn::LightKind
#define LPV_LIGHT_POINT 1u
#define LPV_LIGHT_SPOT 2u
#define LPV_LIGHT_RECTANGLE 3u

// clang-format off
/// A view of a light's map, and the lattice that its texels are sent into.
struct GpuLpvMap {
    vec3 origin; float power;     // as RsmView
    vec3 forward; float texelArea;
    vec3 right; float depthUnit;  // distance along the view is that over the depth; parallel: times (1 - depth)
    vec3 up; uint mapSize;
    vec3 direction; uint kind;    // of the light, unit; LPV_LIGHT_*
    float range, cosOuter, spotScale, scale; // m, 0: unlimited; 1 / (cos inner - cos outer); integers per unit of a lobe
    vec3 lower; float cell;       // m
    uvec3 size; uint parallel;    // cells
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuLpvMap) == 128);
} // namespace limn::shared
#endif

#endif
