// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/parallel.h"
#include "engine/techniques/illuminance/bake/rays/form_factor.h"
#include "engine/techniques/illuminance/bake/rays/gather.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numbers>
#include <span>
#include <vector>

namespace limn {

/// Irradiance from a sender of radiosity 1, divided by its solid angle / pi; for a cell of the
/// grid, half the mean over all normals that see it.
inline float irradianceShare(CacheKind kind, float cosTheta) {
    return kind == CacheKind::Hemisphere ? cosTheta : 0.5f;
}

/// Number of a cache's valid rays: all but the excluded ones. `senders`: what its rays met.
inline std::uint32_t validRays(std::span<const std::uint32_t> senders) {
    return std::uint32_t(senders.size()) -
           std::uint32_t(std::ranges::count(senders, GatherHits::kExcluded));
}

/// Calls visit(point) for each of a cache's points that has rays and does not lie in a wall.
/// `senders`: what the cache's rays met.
template <class Visit>
void forEachValidPoint(const CachePoints& points, std::uint32_t cache,
                       std::span<const std::uint32_t> senders, const Visit& visit) {
    const std::uint32_t first = points.begin[cache], count = points.begin[cache + 1] - first;
    for (std::uint32_t k = 0; k < count && k < senders.size(); ++k)
        if (senders[k] != GatherHits::kExcluded) // ray k is the first of point k
            visit(first + k);
}

/// Irradiance that each of a cache's `rays` rays contributes if its sender has a radiosity of 1.
inline std::vector<float> rayIrradiances(std::uint32_t rays, CacheKind kind) {
    const DirectionSet set = gatherDirections(rays, kind, 0); // the rotation changes no height
    std::vector<float> result(rays);
    for (std::uint32_t r = 0; r < rays; ++r)
        result[r] =
            set.solidAngle(r) / std::numbers::pi_v<float> * irradianceShare(kind, set.height(r));
    return result;
}

/// Calls visit(cache, ray, sender, weight) for every ray of the caches [begin, end) that met a
/// sender, cache after cache. `weight`: the irradiance that a radiosity of 1 there contributes to
/// the cache by this ray, times CachePoints::weight. Rays that are left to aimed samples are not
/// among them.
template <class Visit>
void forEachSeenHit(const GatherHits& hits, const CachePoints& points, const Caches& caches,
                    std::uint32_t begin, std::uint32_t end, const Visit& visit) {
    const std::vector<float> hemisphere = rayIrradiances(hits.rays, CacheKind::Hemisphere),
                             sphere = rayIrradiances(hits.rays, CacheKind::Grid);
    for (std::uint32_t c = begin; c < end; ++c) {
        const std::vector<float>& irradiance =
            caches.kind[c] == CacheKind::Hemisphere ? hemisphere : sphere;
        const std::span<const std::uint32_t> sender = hits.sendersOf(c);
        const double weight =
            double(points.weightOf(c)) * double(hits.rays) / double(validRays(sender));
        for (std::uint32_t r = 0; r < hits.rays; ++r)
            if (sender[r] < GatherHits::kFirstMark)
                visit(c, r, sender[r], weight * double(irradiance[r]));
    }
}

/// Calls visit(sender, FormFactor, u) for each of a cache's aimed samples. Its ray meets a point of
/// a sender and stands for a cone of the sender's solid angle: pi transport / scale = 2 pi u.
template <class Visit>
void forEachAimedSample(const Surfels& surfels, const GatherHits& hits, const CachePoints& points,
                        const Caches& caches, std::uint32_t cache, const Visit& visit) {
    const CacheKind kind = caches.kind[cache];
    for (std::uint32_t k = hits.aimedBegin[cache]; k < hits.aimedBegin[cache + 1]; ++k) {
        const AimedSample& sample = hits.aimed[k];
        const SubtendedSolidAngle v = solidAngleOf(surfels, hits.lamps, points, kind, sample);
        visit(sample.sender,
              FormFactor{v.transport, v.transport * irradianceShare(kind, v.cosTheta),
                         v.direction * v.transport},
              v.transport / (2 * sample.scale));
    }
}

/// Sums over caches per sender. The caches are divided into kParts equal parts; sum[k * senders +
/// s] is that of all caches before part k, and of all caches where k is kParts.
struct SumsOfSenders {
    static constexpr std::uint32_t kParts = 16;
    std::uint32_t senders, caches;
    std::vector<double> sum;

    std::uint32_t begin(std::uint32_t part) const {
        return std::uint32_t(std::uint64_t(caches) * part / kParts);
    }
    std::span<const double> before(std::uint32_t part) const {
        return {sum.data() + std::size_t(part) * senders, senders};
    }
};

/// Sums what add(begin, end, sum) adds to the senders of the caches [begin, end). The parts run in
/// parallel, and the result does not depend on the number of threads.
template <class Add>
SumsOfSenders sumOverCaches(std::uint32_t caches, std::uint32_t senders, const Add& add) {
    constexpr std::uint32_t kParts = SumsOfSenders::kParts;
    SumsOfSenders result{senders, caches, {}};
    result.sum.assign(std::size_t(kParts + 1) * senders, 0);
    const auto sumsOf = [&](std::uint32_t part) {
        return std::span(result.sum).subspan(std::size_t(part) * senders, senders);
    };
    parallelRanges(kParts, 1, [&](std::size_t first, std::size_t last) {
        for (auto k = std::uint32_t(first); k < last; ++k)
            add(result.begin(k), result.begin(k + 1), sumsOf(k + 1));
    });
    for (std::uint32_t k = 1; k <= kParts; ++k)
        std::ranges::transform(sumsOf(k - 1), sumsOf(k), sumsOf(k).begin(), std::plus<>());
    return result;
}

} // namespace limn
