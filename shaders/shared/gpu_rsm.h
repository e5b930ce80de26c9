// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_RSM_H
#define SHADERS_SHARED_GPU_RSM_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec3.hpp>
namespace limn::shared {
using glm::vec3;
using uint = std::uint32_t;
#endif

// The first bindings of set 0 of shaders that read reflective shadow maps
#define RSM_ALBEDO 0u
#define RSM_SURFACE 1u
#define RSM_DEPTH 2u
#define RSM_BINDINGS 3u

#define RSM_LIGHT_SUN 0u // as limn::LightKind
#define RSM_LIGHT_POINT 1u
#define RSM_LIGHT_SPOT 2u
#define RSM_LIGHT_RECTANGLE 3u

// clang-format off
/// A view of a light's map.
struct GpuRsmView {
    vec3 origin; float power;     // as RsmView
    vec3 forward; float texelArea;
    vec3 right; float depthUnit;  // distance along the view is that over the depth; parallel: times (1 - depth)
    vec3 up; uint mapSize;
    vec3 direction; uint kind;    // of the light, unit; RSM_LIGHT_*
    float range, cosOuter, spotScale; uint parallel; // m, 0: unlimited; 1 / (cos inner - cos outer)
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuRsmView) == 96);
} // namespace limn::shared
#endif

#endif
