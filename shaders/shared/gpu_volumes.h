// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_VOLUMES_H
#define SHADERS_SHARED_GPU_VOLUMES_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
namespace limn::shared {
using glm::uvec2;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using uint = std::uint32_t;
#endif

// Bindings of set 1 of volume_light.frag
#define VOLUME_GRIDS 0u
#define VOLUME_ADDRESS 1u   // uint: a cache or VOLUME_NO_CACHE for each node of each grid
#define VOLUME_HARMONICS 2u // float: three colours of each coefficient of each cache
#define VOLUME_GLOSSY 3u    // float: three colours of each texel of the map of each cache
#define VOLUME_BINDINGS 4u

#define VOLUME_MAX_GRIDS 4u
#define VOLUME_NO_CACHE 0xffffffffu

// clang-format off
/// A CacheGrid.
struct GpuCacheGrid {
    vec3 lower; float cell;
    uvec3 nodes; uint first;            // the first node's number among those of all grids
    vec3 decisionLower; uint pad0;
    vec3 decisionUpper; uint pad1;
};

/// CacheGrids, and the maps for reflections.
struct GpuCacheGrids {
    GpuCacheGrid grid[VOLUME_MAX_GRIDS]; // the finest first
    vec3 eye; uint count;                // of the maps; grids
    float transition; uint tile, pad0, pad1; // cells; texels along a map's side, 0: no maps
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuCacheGrids) == 4 * 64 + 32);
} // namespace limn::shared
#endif

#endif
