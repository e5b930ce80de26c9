// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/sampling.h"
#include "engine/techniques/illuminance/bake/receivers/cache_points.h"

#include <array>
#include <cstdint>

namespace limn {

/// Directions of a cache's rays. Those of a surface cache sample a mixture of two densities, half
/// uniform and half proportional to the cosine, by which irradiance weights radiance. Its variance
/// is lower than that of uniform directions where light comes from near the normal, and never more
/// than twice that of either (Hesterberg. Weighted Average Importance Sampling and Defensive
/// Mixture Distributions. 1995).
inline DirectionSet gatherDirections(std::uint32_t rays, CacheKind kind, std::uint32_t seed) {
    return {rays, kind != CacheKind::Hemisphere, seed, 0.5f};
}

/// The rays of a cache, which depend only on its kind, its points with their seed, and the number
/// of rays. Local z is the point's normal (world z for Grid).
struct CacheRays {
    DirectionSet local;
    std::uint32_t points;
    std::array<glm::mat3, AtlasTexel::kMaxPoints> toWorld;

    glm::vec3 operator[](std::uint32_t r) const { return toWorld[r % points] * local[r]; }
};
CacheRays raysOf(const Caches& caches, const CachePoints& points, std::uint32_t cache,
                 std::uint32_t rays);

} // namespace limn
