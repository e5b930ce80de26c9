// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std140, std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_LIGHT_H
#define SHADERS_SHARED_GPU_LIGHT_H

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

#define LIGHT_DIRECTIONAL 0u
#define LIGHT_POINT 1u
#define LIGHT_SPOT 2u
#define LIGHT_RECTANGLE 3u

#define LIGHT_MOST_IRRADIANCE 1e28f // maximum per colour channel

#define SHADOW_SINGLE 1u // views of a light's shadow
#define SHADOW_CUBE 6u
#define SHADOW_RECTANGLE 24u // a cube for each quarter of a rectangle

#define SHADOW_MARGIN 4 // texels at the rim of a cascade that only the filter reads

#define SHADOW_NEAR 1e-4 // near plane of perspective views as a fraction of the far plane

// clang-format off
/// A light as shaders read it. sampleLight() of engine/scene/light/light.cpp computes the same.
struct GpuLight {
    vec3 position;  float inverseRange; // m; 1/m, 0: unlimited
    vec3 direction; uint kind;          // unit, the way light travels; LIGHT_*
    vec3 strength;  float spotScale;    // colour times lux, cd or nits; 1 / (cos inner - cos outer)
    float cosOuter; uint shadowViews; uint firstView; float halfHeight; // m
    vec3 halfWidth; uint cascades; // m; of a rectangle, to the middle of an edge; with a profile, unit, at 0 degrees;
                                   // cascade views, which follow the others
    uint profile, profileSize; float firstVertical, lastVertical; // where its values begin in the buffer of all lights
                                   // [floats], 0: none; rows, from bit 16 on columns; degrees
};

/// A shadow map: a tile of one layer of the atlas.
struct GpuShadowView {
    mat4 toAtlas;      // world to (u, v, depth) w; depth 1 near, 0 far
    vec4 axis;         // unit, the way it looks; w: dot(axis, eye)
    float texelSize;   // m: a texel's width; perspective views: at distance 1 m along the axis
    float perspective; // 1, or 0 for orthographic
    uint layer; float zFar; // m; perspective views
    vec4 inside; // minimum and maximum atlas coordinates that a cascade serves
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuLight) == 96);
static_assert(sizeof(GpuShadowView) == 112);
} // namespace limn::shared
#endif

#endif
