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

/// Reference for what some caches of one kind see, from many more rays than a bake shoots.
struct SightReference {
    std::vector<std::uint32_t> cache; ///< indices of valid caches of the bake, ascending
    CachePoints points;               ///< of `cache`, in that order
    Caches caches;                    ///< only kind, position and normal are filled
    std::uint32_t rays = 0;           ///< per cache
    /// sender[i * rays + r]: leaf of the tree that ray r of cache[i] met, or a mark of GatherHits.
    std::vector<std::uint32_t> sender;
};

/// Traces every k-th cache of `kind`, at most `count`, with `multiple` times the bake's rays.
/// `points`: of the bake's caches from `first` on. Rays of points in walls are left out, as in the
/// bake. Empty when cancelled.
SightReference traceSights(const TraceScene& trace, const SurfelSet& set, const OwnerTables& owners,
                           const Bake& bake, CacheKind kind, const CachePoints& points,
                           std::uint32_t first, std::uint32_t count, std::uint32_t multiple,
                           const Progress& progress = {});

/// Error of the light that a bake's links bring to caches, including the error from its number of
/// rays.
struct LinkError {
    static constexpr std::array<float, 3> kTilts = {0, 30, 60}; ///< [degrees]

    /// Per band: rms error of single links' coefficients over their rms, against the projections of
    /// the reference's rays that meet their clusters.
    std::array<double, kMaxBands> link{};
    /// Per band: the same error of the caches' sums over links, in luma, against the sums over all
    /// rays of what each ray's sender sends. The clusters' error is part of it.
    std::array<double, kMaxBands> lit{};
    /// Irradiance from the first kIrradianceBands bands: rms error / mean, in luma, against the sum
    /// over all rays with the clamped cosine. Per tilt, on surfaces whose normals are tilted by
    /// that angle from the cache's, in four directions. For cells of the grid all three entries are
    /// the same, along the six axes.
    std::array<double, kTilts.size()> irradiance{};
    double unlinked =
        0; ///< share of the rays that meet clusters without a link, as the bake's rays missed them
    std::uint64_t links = 0;
};

/// Measures a bake's links against a reference. `radiosity`: of the tree's nodes, as
/// Relighter::radiosity().
LinkError measureLinks(const Bake& bake, const SightReference& reference,
                       const std::vector<glm::vec4>& radiosity);

} // namespace limn
