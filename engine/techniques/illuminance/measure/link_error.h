// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/sh.h"
#include "engine/techniques/illuminance/bake/receivers/cache_points.h"
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

namespace limn {

/// What some caches of one kind see, by many more rays than a bake shoots.
struct SightReference {
    std::vector<std::uint32_t> cache; ///< of the bake; valid ones, rising
    CachePoints points;               ///< of `cache`, in that order
    Caches caches;                    ///< of which only kind, position, normal are filled
    std::uint32_t rays = 0;           ///< per cache
    /// sender[i * rays + r]: leaf of the tree that ray r of cache[i] met, or a mark of GatherHits.
    std::vector<std::uint32_t> sender;
};

/// Every k-th cache of `kind`, `count` at most, with `multiple` times the bake's rays. `points`: of
/// the bake's caches from `first` on. Empty when cancelled. Rays of points in walls are left out,
/// as in the bake.
SightReference traceSights(const TraceScene& trace, const SurfelSet& set, const OwnerTables& owners,
                           const Bake& bake, CacheKind kind, const CachePoints& points,
                           std::uint32_t first, std::uint32_t count, std::uint32_t multiple,
                           const Progress& progress = {});

/// Error of what a bake's links bring to caches, the number of its rays included.
struct LinkError {
    static constexpr std::array<float, 3> kTilts = {0, 30, 60}; ///< [degrees]

    /// Per band: rms error of single links' coefficients over their rms, against the projections of
    /// the reference's rays that meet their clusters.
    std::array<double, kMaxBands> link{};
    /// Per band: the same of the caches' sums over links, in luma, against the sums over all rays
    /// of what each one's sender sends: the clusters' error is part of it.
    std::array<double, kMaxBands> lit{};
    /// Irradiance, by the first kIrradianceBands bands: rms error / mean, in luma. On surfaces of
    /// normals tilted by so much from the cache's, in four directions, against the sum over all
    /// rays with the clamped cosine. Cells of the grid: along the six axes, three times the same.
    std::array<double, kTilts.size()> irradiance{};
    double unlinked =
        0; ///< share of the rays that meet clusters without a link: the bake's rays missed them
    std::uint64_t links = 0;
};

/// `radiosity`: what nodes of the tree send, as Relighter::radiosity().
LinkError measureLinks(const Bake& bake, const SightReference& reference,
                       const std::vector<glm::vec4>& radiosity);

} // namespace limn
