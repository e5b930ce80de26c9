// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"

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

/// About how many caches a bake of the scene will have, as many of them surfels' own as there may
/// be. With texelsPerMetre the texels at the charts' borders are not counted. Cheap unless that is
/// set; then it sums the areas of all triangles. Without what minTexels() says.
std::uint64_t expectedCaches(const Scene& scene);

/// About how many lightmap texels the scene's static objects need, however few are asked for. Each
/// chart needs one, but small charts of an object that face the same way share one. So an object
/// needs one for each of the axes' six directions that some of its triangles face, two where both
/// sides are lit.
std::uint64_t minTexels(const Scene& scene);

/// What a bake of a scene will take, estimated before it starts. Of 16 scenes and settings, real
/// and generated, one had a file and one a peak further off than a quarter, by a third or so. Least
/// certain: how many lamps' surfels caches see, and how many caches a scene of fine parts gets.
struct BakePrediction {
    std::uint64_t caches = 0;    ///< expectedCaches(), and no fewer than minTexels()
    std::uint64_t minTexels = 0; ///< where more than were asked for; else 0
    BakeBytes bytes;             ///< of the bake; links as they are expected, not a bound
    std::uint64_t file = 0;      ///< size of its file [bytes]
    std::uint64_t working = 0; ///< most memory while baking and writing, besides the scene [bytes]
};

/// `stored`: a StageStore will keep the stages. Cheap unless something emits; then it sums the
/// areas of all triangles.
BakePrediction predictBake(const Scene& scene, bool stored = false);

} // namespace limn
