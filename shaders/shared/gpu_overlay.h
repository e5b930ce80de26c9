// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std140, std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_OVERLAY_H
#define SHADERS_SHARED_GPU_OVERLAY_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
namespace limn::shared {
using glm::mat4;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
#endif

// The order of limn::MarkShape.
#define MARK_DISC 0u
#define MARK_SQUARE 1u
#define MARK_RING 2u

// clang-format off
/// Push constants of overlay_mark.
struct GpuOverlayMarks {
    mat4 toClip;               // world to clip
    vec3 eye; float pixelSize; // m; a pixel's height at distance 1
};

/// Push constants of overlay_surface.
struct GpuOverlaySurface {
    mat4 toClip;         // object to clip
    vec4 toWorld[3];     // rows of object to world
    vec3 eye;            // m
    float sideOffset;    // offset in v of the lightmap from the place of a front down to that of its back; negative: the transform mirrors
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuOverlayMarks) == 80);
static_assert(sizeof(GpuOverlaySurface) == 128);
} // namespace limn::shared
#endif

#endif
