// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_VOLUMES_H
#define SHADERS_SHARED_GPU_VOLUMES_H

#include "shaders/shared/gpu_rsm.h"

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec3.hpp>
namespace limn::shared {
using glm::uvec3;
using glm::vec3;
using uint = std::uint32_t;
#endif

// Bindings of set 1 of volume_light.frag
#define VOLUME_GRIDS 0u
#define VOLUME_ADDRESS 1u   // uint: a cache or VOLUME_NO_CACHE for each node of each grid
#define VOLUME_HARMONICS 2u // float: three colours of each coefficient of each cache
#define VOLUME_GLOSSY 3u    // float: three colours of each texel of the map of each cache
#define VOLUME_BINDINGS 4u

// Bindings of set 0 of volume_map.comp, after those of the map, and of volume_blocks.comp
#define VOLUME_MAP_LIGHTS 3u // GpuAreaLight
#define VOLUME_MAP_BLOCKS 4u // GpuLightBlock
#define VOLUME_MAP_BINDINGS 5u
#define VOLUME_MAP_LANES 8u // along each side of a workgroup

// Bindings of set 0 of volume_demand.comp and volume_missed.comp
#define VOLUME_DEMAND_SURFACE 0u
#define VOLUME_DEMAND_DEPTH 1u
#define VOLUME_DEMAND_GRIDS 2u
#define VOLUME_DEMAND_SUMS 3u   // GpuPlaceSums for each node of each grid
#define VOLUME_DEMAND_MISSED 4u // of volume_missed.comp, which has addresses in place of the sums
#define VOLUME_DEMAND_BINDINGS 5u

// Bindings of set 0 of volume_caches.comp
#define VOLUME_CACHE_PLACES 0u // GpuCachePlace
#define VOLUME_CACHE_LIGHTS 1u
#define VOLUME_CACHE_BLOCKS 2u
#define VOLUME_CACHE_VOXELS                                                                        \
    3u // uint for each cell: bytes along x, y, z, and mean; of level 0: opacity, 0, 0, distance
#define VOLUME_CACHE_HARMONICS 4u
#define VOLUME_CACHE_VISIBILITY 5u // float for each block of each cache, where there are maps
#define VOLUME_CACHE_GLOSSY 6u     // of volume_maps.comp
#define VOLUME_CACHE_BINDINGS 7u
#define VOLUME_CACHE_LANES 32u

#define VOLUME_SHADOWS_NONE 0u // as limn::ConeShadows
#define VOLUME_SHADOWS_DIRECTIONAL 1u
#define VOLUME_SHADOWS_PUBLISHED 2u

#define VOLUME_PLACE_UNIT 4096.0 // integers per unit of GpuPlaceSums

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
    float transition; uint tile; // cells; texels along a map's side, 0: no maps
    uint clamped, pad0;          // 1: each cache's irradiance is clamped to 0
};

/// A virtual area light. Those of a block lie one behind the other, dark ones too.
struct GpuAreaLight {
    vec3 place; float disc;      // m; area across the beam over pi, m^2
    vec3 normal; float normals;  // unit; length of the sum of its texels' normals
    vec3 flux; float count;      // of a light of colour 1; texels that reflect anything
    float distance, squares; uint pad0, pad1; // sums over them, m and m^2
};

/// An AreaLightBlock.
struct GpuLightBlock {
    vec3 place; float width;
    vec3 normal; uint lit; // area lights that reflect anything
};

/// Push constants of volume_map.comp and volume_blocks.comp.
struct GpuVolumeMap {
    GpuRsmView view;
    uint side, blockSide;   // area lights, and blocks, along a side of the view
    uint firstLight, firstBlock;
};

/// Push constants of volume_demand.comp: a camera's picture.
struct GpuVolumeDemand {
    vec3 eye; float depthOffset;      // m; distance along the axis is depthScale / (depth - depthOffset)
    vec3 rayCentre; float depthScale; // ray of the picture's middle, 1 m deep
    vec3 rayRight; uint width;        // from the middle to the edges; pixels
    vec3 rayUp; uint height;
};

/// CachePlaceSums of a node, in integers.
struct GpuPlaceSums {
    int surfaces, x, y, z, height; // number; normals; heights in cells
    int shiftX, shiftY, shiftZ;    // from the node to the points, in cells
};

/// A CachePlace, and where its cones start.
struct GpuCachePlace {
    vec3 position; uint pad0;
    vec3 raised; uint pad1;
};

/// Push constants of volume_caches.comp: one light.
struct GpuVolumeLight {
    vec3 colour; uint blocks;
    vec3 voxelLower; float voxelCell; // m
    uint voxelSide, shadows;          // voxels along a side; VOLUME_SHADOWS_*
    uint blockLights, parallel;       // area lights of a block; 1: those of a sun
    float raise; uint caches, first;  // m; 1: replaces what the caches hold
    uint keepsVisibility;             // 1: for volume_maps.comp
};

/// Push constants of volume_maps.comp, one light or, without blocks, the end of all, and of volume_fill.comp.
struct GpuVolumeMaps {
    vec3 eye; uint tile;              // texels along a map's side
    vec3 colour; uint caches;
    uint blocks, blockLights, fill, first; // levels that are filled; 1: the maps are cleared
    uint microfacet, pad0, pad1, pad2;     // 1: lobes are those of GlossyMapShape::microfacet
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuVolumeMap) == 112);
static_assert(sizeof(GpuAreaLight) == 64);
static_assert(sizeof(GpuPlaceSums) == 32);
static_assert(sizeof(GpuVolumeLight) == 64);
static_assert(sizeof(GpuVolumeMaps) == 64);
static_assert(sizeof(GpuCacheGrids) == 4 * 64 + 32);
} // namespace limn::shared
#endif

#endif
