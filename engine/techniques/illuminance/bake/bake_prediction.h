// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake_bytes.h"

#include <cstdint>

namespace limn {

/// Approximate number of caches in a bake of the scene, with the maximum number of surfel caches.
/// With texelsPerMetre the texels at the charts' borders are not counted. Cheap unless that is set;
/// then it sums the areas of all triangles. Does not take minTexels() into account.
std::uint64_t expectedCaches(const Scene& scene);

/// Approximate minimum number of lightmap texels that the scene's static objects need, however few
/// are asked for. Each chart needs one, but small charts of an object that face the same way share
/// one. So an object needs one for each of the axes' six directions that some of its triangles
/// face, two where both sides are lit.
std::uint64_t minTexels(const Scene& scene);

/// Estimate of the memory and file size of a bake, made before it starts. Over 16 scenes and
/// settings, real and generated, one file and one peak were off by more than a quarter, by about a
/// third. The least certain quantities are how many texels the light from lamps adds, up to as many
/// as are asked for, how many lamp surfels the caches see, and how many caches a scene of fine
/// parts gets.
struct BakePrediction {
    std::uint64_t caches = 0;     ///< expectedCaches(), but at least minTexels()
    std::uint64_t gridCaches = 0; ///< of those, caches of the grid
    double leaves = 0;            ///< senders that a cache sees
    double links = 0;             ///< expected number of links of all caches
    std::uint64_t minTexels = 0;  ///< needed, where more than were asked for; else 0
    BakeBytes bytes;              ///< of the bake; links are the expected number, not a bound
    std::uint64_t file = 0;       ///< size of its file [bytes]
    std::uint64_t working = 0; ///< peak memory while baking and writing, besides the scene [bytes]
};

/// Estimates a bake of the scene. `stored`: a StageStore will keep the stages. Cheap unless
/// something emits; then it sums the areas of all triangles.
BakePrediction predictBake(const Scene& scene, bool stored = false);

} // namespace limn
