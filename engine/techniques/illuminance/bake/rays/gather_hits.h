// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/packing.h"
#include "engine/techniques/illuminance/bake/senders/lamp_patches.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace limn {

/// A sender visible from one of a cache's points, found by a ray aimed at it.
struct AimedSample {
    std::uint32_t sender; ///< leaf of the ClusterTree
    std::uint32_t point;  ///< of CachePoints
    float scale = 1;      ///< senders that it stands for, itself included [1]
};

/// A ray that was traced from a cache and met the sky.
struct SkyHit {
    std::uint32_t sender; ///< a sky cell: leaf of the ClusterTree
    std::uint32_t point;  ///< of CachePoints
    Oct16 direction;
    float transport; ///< solid angle that it stands for / pi
};

/// Sky that caches see through openings, found by findSkyHits(). all[begin[c] … begin[c + 1])
/// belong to cache c; a cache has none, or all that its rays found.
struct SkyHits {
    std::vector<std::uint32_t> begin; ///< empty: not searched
    std::vector<SkyHit> all;
    std::uint64_t rays = 0; ///< traced for this result
};

/// What every ray of every cache met: sender[cache * rays + r] is a leaf of the ClusterTree or one
/// of the marks below. Ray r of a cache runs along CacheRays[r], so directions need not be stored.
/// aimed[aimedBegin[c] … aimedBegin[c + 1]) belong to cache c.
struct GatherHits {
    static constexpr std::uint32_t kBackFace =
        ~0U; ///< the back of a one-sided surface: carries nothing
    /// A lamp or the sky: left to the cache's aimed samples or SkyHits.
    static constexpr std::uint32_t kAimed = ~0U - 1;
    static constexpr std::uint32_t kExcluded =
        ~0U - 2; ///< the ray starts in a wall: it does not count
    static constexpr std::uint32_t kFirstMark = kExcluded;
    std::uint32_t rays = 0;
    std::vector<std::uint32_t> sender;
    std::vector<std::uint32_t> aimedBegin;
    std::vector<AimedSample> aimed;
    LampPatches lamps; ///< whose points the aimed rays ran to
    SkyHits sky;

    /// What a cache's rays met.
    std::span<const std::uint32_t> sendersOf(std::uint32_t cache) const {
        return {sender.data() + std::size_t(cache) * rays, rays};
    }
};

} // namespace limn
