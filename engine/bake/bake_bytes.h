// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/bake.h"

#include <cstdint>

namespace limn {

/// Memory that relighting reads, without the charts of the lightmap.
struct BakeBytes {
    std::uint64_t surfels = 0, clusters = 0, links = 0, caches = 0;
    std::uint64_t total() const { return surfels + clusters + links + caches; }
};

BakeBytes bytesOf(const Bake& bake);

/// The same, were its links of this storage and number of bands: the same links either way.
BakeBytes bytesOf(const Bake& bake, LinkStorage storage, std::uint32_t bands);

/// What a bake with these settings will take, known before it starts. Exact for as many surfels as
/// given. Links: an upper bound, n_L for every cache; those in walls get none, those that see less
/// get fewer, and CutCriterion::Detail keeps to the same sum. Caches: exact but for the sources of
/// those in walls, at most 32 bytes each, and, where the settings leave the grid's size open, for
/// how far its cells see, 512 bytes each.
BakeBytes predictBytes(const BakeSettings& settings, std::uint64_t surfels, std::uint64_t caches);

/// Memory that a bake with these settings takes while it runs, without the scene [bytes]. Rough:
/// fitted to samples and real scenes of 5 000 to 38 000 caches, of which it was from 0.9 to 2 times
/// what they took. Good enough to tell what cannot be done.
std::uint64_t roughPeak(const BakeSettings& settings, std::uint64_t caches);

/// About how many caches a bake of the scene will have, as many of them surfels' own as there may
/// be. With texelsPerMetre the texels at the charts' borders are not counted. Cheap unless that is
/// set; then it sums the areas of all triangles.
std::uint64_t expectedCaches(const Scene& scene);

} // namespace limn
