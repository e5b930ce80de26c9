// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/probe_maps.h"

#include "engine/core/parallel.h"
#include "engine/math/sampling.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace limn {

namespace {

/// Directions by which the moments of one direction are filtered, and their radius, as in McGuire
/// et al. 2017.
constexpr std::uint32_t kFilterRays = 128;
constexpr float kFilterRadius = 0.5f;
/// Distances are clamped to this many diagonals of a cell. No lookup is farther from its probe than
/// one, and a far horizon must not swamp the variance (Majercik et al. 2019).
constexpr float kFar = 1.5f;
/// Backs of solids count as this much nearer, so that probes outside a closed room do not light
/// what is in it (Majercik, Marrs, Spjut, McGuire. Scaling Probe-Based Real-Time Dynamic Global
/// Illumination for Production. 2021).
constexpr float kBackDistance = 0.2f;

ProbeHit look(const Scene& scene, const TraceScene& trace, glm::vec3 from, glm::vec3 direction) {
    const Hit hit = trace.closestHit({from, direction});
    if (!hit)
        return {};
    const bool solid =
        !hit.frontFace && !isTwoSided(scene.materialOf(scene.instances[hit.instance]));
    return {hit.instance, hit.triangle, hit.u,
            hit.v,        hit.t,        solid ? kInSolid : hit.frontFace ? 0U : 1U};
}

} // namespace

ProbeMaps emptyMaps(const ProbeGrid& grid, std::uint32_t side) {
    ProbeMaps maps{grid, {side}, {}, {}, {}};
    maps.hits.resize(std::size_t(grid.count()) * maps.map.texels());
    maps.inSolid.resize(grid.count());
    maps.moments.texels.resize(std::size_t(grid.count()) * kGridDepthTexels);
    return maps;
}

void traceProbe(const Scene& scene, const TraceScene& trace, std::uint32_t probe, ProbeMaps& maps) {
    const std::uint32_t texels = maps.map.texels();
    ProbeHit* hits = maps.hits.data() + std::size_t(probe) * texels;
    const glm::vec3 from = maps.grid.position(probe);
    parallelRanges(texels, 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t)
            hits[t] = look(scene, trace, from, maps.map.direction(std::uint32_t(t)));
    });
    std::uint32_t backs = 0;
    for (std::uint32_t t = 0; t < texels; ++t)
        backs += hits[t].side == kInSolid ? 1 : 0;
    maps.inSolid[probe] = 4 * backs > texels ? 1 : 0;

    glm::vec2* moments = maps.moments.texels.data() + std::size_t(probe) * kGridDepthTexels;
    const float farthest = kFar * glm::length(maps.grid.step());
    const DirectionSet around(kFilterRays, true, 0);
    parallelRanges(kGridDepthTexels, 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m) {
            const glm::vec3 axis = glm::normalize(gridDepthPoint(std::uint32_t(m)));
            glm::vec2 sum(0);
            for (std::uint32_t r = 0; r < kFilterRays; ++r) {
                const ProbeHit& hit = hits[maps.map.texelAt(axis + kFilterRadius * around[r])];
                const float seen =
                    hit.side == kInSolid ? kBackDistance * hit.distance : hit.distance;
                const float d = hit.instance == ~0U ? farthest : std::min(seen, farthest);
                sum += glm::vec2(d, d * d);
            }
            moments[m] = maps.inSolid[probe] ? glm::vec2(0) : sum / float(kFilterRays);
        }
    });
}

} // namespace limn
