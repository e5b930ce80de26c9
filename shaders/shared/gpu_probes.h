// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_PROBES_H
#define SHADERS_SHARED_GPU_PROBES_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec3.hpp>
namespace limn::shared {
using glm::uvec3;
using glm::vec3;
using uint = std::uint32_t;
#endif

// Bindings of set 0. Harmonics are PROBE_COEFFICIENTS vec4 with w = 0 per probe.
#define PROBE_HITS 0u   // GpuProbeHit per texel of the maps of a block of probes
#define PROBE_DIRECT 1u // irradiance from lights at those hits [W m^-2], a vec4 each
#define PROBE_SKY 2u    // radiance of the sky in the direction of each texel [W m^-2 sr^-1], a vec4
#define PROBE_BASIS 3u  // harmonics of each texel's direction times its solid angle
#define PROBE_BEFORE 4u // radiance at probes, of the bounce before [W m^-2 sr^-1]
#define PROBE_LIGHT 5u  // radiance at probes
#define PROBE_MEANS 6u  // vec4 per probe: the constant harmonic
#define PROBE_MOMENTS 7u  // as GpuField::gridDepth
#define PROBE_GRID 8u     // as GpuField::grid
#define PROBE_RADIANCE 9u // as GpuMarchedMaps::radiance, of all probes
#define PROBE_BINDINGS 10u

// Bindings of set 1 of probe_reflections.frag, as GpuMarchedMaps
#define MARCHED_PLANES 0u
#define MARCHED_NEAREST 1u
#define MARCHED_RADIANCE 2u

#define PROBE_COEFFICIENTS 9u // three bands

// What a texel of a map shows.
#define PROBE_SEES_NOTHING 0u // the back of a solid, or the map was not traced yet
#define PROBE_SEES_SKY 1u
#define PROBE_SEES_SURFACE 2u

// clang-format off
/// What a probe sees in the direction of a texel. The first two rows begin as PointBuffers::points.
struct GpuProbeHit {
    vec3 position; uint albedoRedGreen; // m; two 16-bit unorms
    vec3 normal; uint albedoBlue;       // unit, on the lit side; a 16-bit unorm
    vec3 emission; uint kind;           // W m^-2 sr^-1; PROBE_SEES_*
};

/// Push constants of all steps.
struct GpuProbeRange {
    vec3 gridLower; uint begin;   // m; first probe
    vec3 cellSize; uint end;      // m
    uvec3 gridSize; uint weights; // cells; of the grid's moments, of grid_lookup.h; GRID_PLAIN: light bounces once
    float fieldScale; uint marched; // 1: radiance is written; in probe_levels.comp, the level
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuProbeHit) == 48);
static_assert(sizeof(GpuProbeRange) == 56);
} // namespace limn::shared
#endif

#endif
