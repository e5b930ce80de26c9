// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/surfels.h"
#include "engine/core/progress.h"
#include "engine/math/sampling.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// A sender sampled by a ray towards it rather than met by chance.
struct AimedSample {
    std::uint32_t sender;
    float transport;     ///< visible solid angle / pi
    glm::vec3 direction; ///< unit, away from the cache
};

/// What every ray of every cache met: sender[cache * rays + r] is a leaf of the ClusterTree,
/// kBackFace, or kAimed where the hit is left to the cache's aimed samples. Ray r of a cache runs
/// along raysOf(...)[r], so directions need not be stored. aimed[aimedBegin[c] … aimedBegin[c + 1])
/// belong to cache c.
struct GatherHits {
    static constexpr std::uint32_t kBackFace = ~0U, kAimed = ~0U - 1;
    std::uint32_t rays = 0;
    std::vector<std::uint32_t> sender;
    std::vector<std::uint32_t> aimedBegin;
    std::vector<AimedSample> aimed;
};

/// The rays of a cache: a function of its kind, normal and number alone. Local z is the normal
/// (world z for Grid).
struct CacheRays {
    DirectionSet local;
    glm::mat3 toWorld;

    glm::vec3 operator[](std::uint32_t r) const { return toWorld * local[r]; }
};
CacheRays raysOf(const Caches& caches, std::uint32_t cache, std::uint32_t rays);

/// Shoots `rays` rays per cache at the static scene. A hit is credited to the surfel that owns the
/// hit point, an escaped ray to its sky cell, a back of a one-sided surface to nobody. Returns
/// false when cancelled.
bool gather(const TraceScene& trace, const SurfelSet& set, const Caches& caches, std::uint32_t rays,
            const Progress& progress, GatherHits& hits);

} // namespace limn
