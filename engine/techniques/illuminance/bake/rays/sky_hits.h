// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/illuminance/bake/rays/form_factor.h"
#include "engine/techniques/illuminance/bake/rays/gather.h"

#include <cstdint>

namespace limn {

/// Number of rays that a cache aims at the sky.
inline constexpr std::uint32_t kSkyRays = 64;

struct SkyInput {
    const TraceScene& trace;
    std::size_t surfels; ///< their number
    const Caches& caches;
    const CachePoints& points;
    const GatherHits& hits; ///< of traceHits() with Linker::Gather
    glm::uvec2 lightmap;    ///< its size [texels]
    glm::uvec3 grid;        ///< its number of cells
};

/// Looks for the sky that caches see through windows. Where the neighbours of a cache see the sky
/// with less than an eighth of their rays, chance decides how many of its own rays pass a window:
/// with 256 rays, a window of a hundredth of the hemisphere is found by 2.6 +- 1.6 of them. Such a
/// cache aims kSkyRays more rays around the directions in which its neighbours saw the sky. Every
/// ray that meets the sky, aimed or not, counts with the inverse of the density of both kinds of
/// rays. The sum is thus unbiased, and a bad guess costs nothing but its rays. The cache's own hits
/// do not guide it: a window would then be measured well where it was found, and be missing
/// elsewhere.
///
/// Veach, Guibas. Optimally Combining Sampling Techniques for Monte Carlo Rendering. 1995: the
/// balance heuristic.
///
/// Meaningless when cancelled.
SkyHits findSkyHits(const SkyInput& input, const Progress& progress);

/// Puts the hits of the sky into `hits`. Rays of their caches that met the sky become kAimed.
void takeSkyHits(SkyHits sky, std::size_t surfels, GatherHits& hits);

/// Form factor of a hit of a cache of this kind.
FormFactor formFactorOf(const SkyHit& sky, const CachePoints& points, CacheKind kind);

/// Calls visit(sender, FormFactor) for each of a cache's hits of the sky.
template <class Visit>
void forEachSkyHit(const GatherHits& hits, const CachePoints& points, const Caches& caches,
                   std::uint32_t cache, const Visit& visit) {
    if (hits.sky.begin.empty())
        return;
    for (std::uint32_t k = hits.sky.begin[cache]; k < hits.sky.begin[cache + 1]; ++k)
        visit(hits.sky.all[k].sender, formFactorOf(hits.sky.all[k], points, caches.kind[cache]));
}

} // namespace limn
