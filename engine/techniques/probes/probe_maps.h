// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/grid_moments.h"
#include "engine/techniques/probes/octahedron.h"
#include "engine/techniques/probes/probe_grid.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// What a probe sees in the direction of a texel.
struct ProbeHit {
    std::uint32_t instance = ~0U; ///< of the scene; ~0: the sky
    std::uint32_t triangle = 0;
    float u = 0, v = 0;     ///< barycentrics, weights (1-u-v, u, v)
    float distance = 0;     ///< [m]
    std::uint32_t side = 0; ///< 0: the front; 1: the back of a two-sided surface; 2: of a solid
};
inline constexpr std::uint32_t kInSolid = 2; ///< ProbeHit::side

/// What all probes of a grid see: an octahedral map each.
struct ProbeMaps {
    ProbeGrid grid;
    Octahedron map;
    std::vector<ProbeHit> hits;        ///< map.texels() per probe
    std::vector<std::uint8_t> inSolid; ///< per probe: more than a quarter of its rays hit backs
    GridMoments moments;               ///< of distances, per probe
};

/// Maps of the grid with nothing in them.
ProbeMaps emptyMaps(const ProbeGrid& grid, std::uint32_t side);

/// Traces a probe's map: one ray per texel, through static and dynamic objects, and filters the
/// moments of its distances. Light field probes by McGuire et al. 2017 draw six pictures instead.
void traceProbe(const Scene& scene, const TraceScene& trace, std::uint32_t probe, ProbeMaps& maps);

} // namespace limn
