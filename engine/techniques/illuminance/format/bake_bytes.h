// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"

#include <cstdint>

namespace limn {

/// Memory that relighting reads, excluding the charts of the lightmap [bytes].
struct BakeBytes {
    std::uint64_t surfels = 0, clusters = 0, links = 0, caches = 0;
    std::uint64_t total() const { return surfels + clusters + links + caches; }
};

BakeBytes bytesOf(const Bake& bake);

/// Memory of the same bake with its links stored as `storage` in `bands` bands. The number of links
/// does not depend on either.
BakeBytes bytesOf(const Bake& bake, LinkStorage storage, std::uint32_t bands);

/// Memory that a bake with these settings will take, known before it starts. Surfels and clusters
/// are exact for the given number of surfels. Links are an upper bound, n_L for every cache: caches
/// in walls get none, caches that see less get fewer, and CutCriterion::Detail keeps the same
/// total. Caches are exact but for the fill sources of caches in walls, at most 32 bytes each, and,
/// where the settings leave the grid's size open, for the depths of its cells, 512 bytes each.
BakeBytes predictBytes(const BakeSettings& settings, std::uint64_t surfels, std::uint64_t caches);

/// Memory of the links of `caches` caches, each with `links` of them on average [bytes].
std::uint64_t linkBytes(const BakeSettings& settings, std::uint64_t caches, double links);

} // namespace limn
