// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_RELIGHT_H
#define SHADERS_SHARED_GPU_RELIGHT_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
namespace limn::shared {
using glm::uvec4;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
#endif

// Bindings of set 0. Colours are vec4 with w = 0.
#define RELIGHT_SURFELS 0u   // GpuSurfel per surfel
#define RELIGHT_DIRECT 1u    // irradiance per surfel [W m^-2]
#define RELIGHT_ALBEDO 2u    // per surfel
#define RELIGHT_EMITTED 3u   // pi L_e per surfel [W m^-2]
#define RELIGHT_INDIRECT 4u  // irradiance per surfel [W m^-2]
#define RELIGHT_RADIOSITY 5u // per node of the tree [W m^-2]
#define RELIGHT_CHANGE                                                                             \
    6u // vec4 per bounce and group of surfels: change, total, times area [W]; brightest [W m^-2]
#define RELIGHT_INNER_NODES 7u   // GpuInnerNode, level after level
#define RELIGHT_LEVELS 8u        // where each level begins among the inner nodes
#define RELIGHT_CACHES 9u        // GpuCache per cache
#define RELIGHT_LINKS 10u        // words per link: its node, then a cone or half floats of its SH
#define RELIGHT_SH 11u           // bands^2 per cache [W m^-2 sr^-1]
#define RELIGHT_FILLS 12u        // GpuFill per invalid cache
#define RELIGHT_FILL_SOURCES 13u // uvec2: cache, bits of its weight
#define RELIGHT_GRID 14u         // as IndirectField::grid
#define RELIGHT_ORDER 15u        // caches to light and to write, in lists
#define RELIGHT_LIGHTMAP 16u     // the storage image, one layer per coefficient
#define RELIGHT_BINDINGS 17u

#define RELIGHT_STORAGE_RTP 0u // as limn::LinkStorage
#define RELIGHT_STORAGE_SH 1u
#define RELIGHT_CONE_WORDS 3u // of limn::Link: node; octX, octY; u, transport

// clang-format off
/// Baked data of a surfel.
struct GpuSurfel {
    vec3 position; float seenShare; // m; seenShares() of engine/techniques/illuminance/relight/bouncing.h
    vec3 normal; float area; // unit; m^2
    uvec4 cache;             // where it reads bounced light; ~0: none
    vec4 cacheWeight;
};

/// An inner node of the tree of senders.
struct GpuInnerNode { uint node, left, right; float leftWeight; };

/// A cache's links are [linkBegin, linkEnd); their values are divided by `scale`. The normal is unit; 0 in the grid.
struct GpuCache { uint linkBegin, linkEnd; float scale; uint texel; vec3 normal; float pad; };

/// An invalid cache and its sources [begin, end).
struct GpuFill { uint cache, begin, end, pad; };

/// Push constants of every step: the range of items that it processes.
struct GpuRelightRange {
    uint begin, end;
    uint lightmapCaches; // field: caches below this are texels, the others cells
    uint gridCells;
    float fieldScale; // field: scale of its half floats
    uint changeBegin; // surfels: first vec4 of the bounce's changes
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuSurfel) == 64);
static_assert(sizeof(GpuInnerNode) == 16);
static_assert(sizeof(GpuCache) == 32);
static_assert(sizeof(GpuFill) == 16);
static_assert(sizeof(GpuRelightRange) == 24);
} // namespace limn::shared
#endif

#endif
