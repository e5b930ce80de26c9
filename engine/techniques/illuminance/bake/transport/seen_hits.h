// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/transport/gather.h"

#include <algorithm>
#include <cstdint>

namespace limn {

/// Irradiance from a sender of radiosity 1, divided by its solid angle / pi; for a cell of the
/// grid, half the mean over all normals that see it.
inline float irradianceShare(CacheKind kind, float cosTheta) {
    return kind == CacheKind::Hemisphere ? cosTheta : 0.5f;
}

/// Calls visit(cache, ray, sender, weight) for every ray that met a sender, cache after cache.
/// `weight`: the irradiance that a radiosity of 1 there brings to the cache by this ray, times
/// CachePoints::weight. Rays that are left to aimed samples are not among them.
template <class Visit>
void forEachSeenHit(const GatherHits& hits, const CachePoints& points, const Caches& caches,
                    const Visit& visit) {
    for (std::uint32_t c = 0; c < caches.size(); ++c) {
        const CacheKind kind = caches.kind[c];
        const bool sphere = kind != CacheKind::Hemisphere;
        const DirectionSet rays(hits.rays, sphere, 0); // the rotation changes no height
        const std::uint32_t* sender = hits.sender.data() + std::size_t(c) * hits.rays;
        const auto kept =
            hits.rays - std::uint32_t(std::count(sender, sender + hits.rays, GatherHits::kLeftOut));
        const auto weight = double(points.weightOf(c));
        for (std::uint32_t r = 0; r < hits.rays; ++r)
            if (sender[r] < GatherHits::kFirstMark)
                visit(c, r, sender[r],
                      weight * double((sphere ? 4.f : 2.f) / float(kept) *
                                      irradianceShare(kind, rays.height(r))));
    }
}

} // namespace limn
