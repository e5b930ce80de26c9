// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/sparse_probes/receivers.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Weight of a probe at a share t >= 0 of the radius that it reaches: 2 t^3 - 3 t^2 + 1, 0 from
/// there on. Silvennoinen, Lehtinen. Real-time Global Illumination by Precomputed Local
/// Reconstruction from Sparse Radiance Probes. 2017
inline float probeFalloff(float t) {
    return t < 1 ? (2 * t - 3) * t * t + 1 : 0;
}

/// Air that surfaces look into, in cubic cells.
struct OpenAir {
    std::vector<glm::vec3> besideSurfaces; ///< middles of cells with a surface next to them
    double volume = 0;                     ///< of all cells [m^3]
};

/// Finds the open air over the static scene, with `cells` cells along its longest side and one more
/// all around. Air spreads from the receivers' fronts, from one cell's middle to the next where no
/// surface lies between them, so it never enters a closed solid. Where more than a quarter of a
/// cell's view is backs of one-sided surfaces, no probe shall stand; where that is so on average
/// over cells that air connects, as around a room whose walls have no outside, it is not open at
/// all. Incomplete when cancelled.
OpenAir findOpenAir(const TraceScene& trace, std::span<const glm::vec3> positions,
                    std::span<const glm::vec3> normals, std::uint32_t cells,
                    const Progress& progress);

/// Removes the densest point again and again until `left` are left. The density at a point is the
/// sum of probeFalloff() of the distances to all others, over `radius`. The last of those that
/// differ by no more than rounding goes first.
std::vector<glm::vec3> removeDensest(std::vector<glm::vec3> points, float radius, std::size_t left);

/// Places about `wanted` probes: all candidates, thinned out in three steps, each with a radius
/// twice that of the one before. The last radius is the distance rho for which Silvennoinen and
/// Lehtinen would keep that many: wanted = (1 + V^(1/3) / rho)^3.
std::vector<glm::vec3> placeProbes(const OpenAir& air, std::uint32_t wanted);

} // namespace limn
