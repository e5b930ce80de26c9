// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std140, std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_FRAME_H
#define SHADERS_SHARED_GPU_FRAME_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
namespace limn::shared {
using glm::mat4;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
#endif

// Bindings of set 0 of all passes over a picture: what is seen in each pixel, and the lights
#define FRAME_BLOCK 0u
#define FRAME_LIGHTS 1u
#define FRAME_SHADOW_VIEWS 2u
#define FRAME_SHADOW_ATLAS 3u
#define FRAME_SURFACE 4u // images, as surface.frag writes them
#define FRAME_DEPTH 5u
#define FRAME_EMITTED 6u
#define FRAME_RECEIVER 7u
#define FRAME_REFLECTIONS 8u // limn::reflectionTable()
#define FRAME_LOOKUP_SNAPS 9u
#define FRAME_BINDINGS 10u

// Bindings of set 1 of indirect.frag: the field that it samples
#define FIELD_LIGHTMAP 0u
#define FIELD_GRID 1u
#define FIELD_GRID_WEIGHTS 2u
#define FIELD_BINDINGS 3u

// clang-format off
/// Data that all draws of a frame share.
struct GpuFrame {
    vec3 eye;       uint lightCount;  // m; lights that shine
    vec3 gridLower; uint gridCells;   // m; 0: no grid
    vec3 gridScale; float normalBias; // cells per m; shadow texels along the normal
    uvec3 gridSize; float lightBias;  // cells; shadow texels towards the light
    vec3 rayCentre; float depthScale;  // ray of the picture's middle, 1 m deep; distance along it is
    vec3 rayRight;  float depthOffset; // depthScale / (depth + depthOffset)
    vec3 rayUp;     float gridReach;   // from the middle to the right and upper edges; m
    vec2 pixelSize; vec2 lookupSize;   // 1 / picture's size in pixels; texels of the lightmap, 0: no snaps
    vec3 background; float fieldUnit;  // nits, where no surface is; what the field's halfs count
    uint gridWeights; uint pad; // GRID_* of grid_lookup.h
    float cutBelow; // 1: the lightmap's light continues below surfaces (engine/math/horizon.h); 0: it does not
    float positionError; // m per m of depth, of engine/render/position_error.h
};

/// Push constants of the geometry passes.
struct GpuDraw {
    mat4 toClip;     // object to clip
    vec4 toWorld[3]; // rows of object to world
    uint flags;      // DRAW_*
    float backOffset; // offset in v of the lightmap from the place of a front down to that of its back
    float nearReach;  // m; of nearReaches() of engine/lightmap/near_reach.h
    uint instance;    // index into limn::Scene::instances
};
// clang-format on

#define DRAW_DOUBLE_SIDED 1u
#define DRAW_MIRRORED 2u // the transform has a negative determinant

#ifdef __cplusplus
static_assert(sizeof(GpuFrame) == 160);
static_assert(sizeof(GpuDraw) == 128);
} // namespace limn::shared
#endif

#endif
