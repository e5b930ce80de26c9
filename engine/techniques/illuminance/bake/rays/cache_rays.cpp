// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/rays/cache_rays.h"

namespace limn {

CacheRays raysOf(const Caches& caches, const CachePoints& points, std::uint32_t cache,
                 std::uint32_t rays) {
    const std::uint32_t first = points.begin[cache], count = points.begin[cache + 1] - first;
    CacheRays result{gatherDirections(rays, caches.kind[cache], points.seed[cache]), count, {}};
    for (std::uint32_t k = 0; k < count; ++k)
        result.toWorld[k] = basisAround(
            caches.kind[cache] == CacheKind::Grid ? glm::vec3(0, 0, 1) : points.normal[first + k]);
    return result;
}

} // namespace limn
