// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/texel_points.h"
#include "engine/techniques/illuminance/format/bake.h"

namespace limn {

class SideLookup;

/// Points at which a cache's rays start: ray r leaves points[r mod count], about that point's
/// normal. A cache thus gathers over the whole surface that its texel stands for, folds and edges
/// included, and points that lie in a wall can be left out.
struct CachePoints {
    std::vector<std::uint32_t> begin;        ///< caches + 1 offsets
    std::vector<glm::vec3> position, normal; ///< world; normal 0 for Grid
    /// Per cache, rotates its ray directions. It depends only on the place in the mesh or the grid,
    /// so that a cache keeps its rays when objects are added, removed or moved.
    std::vector<std::uint32_t> seed;
    /// How much a cache counts beside the others where senders are fitted to what caches see, for
    /// the first caches; 1 for all others. A texel that was added near a lamp counts by its area,
    /// since there are many of them where it is bright.
    std::vector<float> weight;

    float weightOf(std::size_t cache) const { return cache < weight.size() ? weight[cache] : 1; }
};

/// Creates the caches of an atlas' texels and fills kind, mean position, mean normal and texel.
Caches placeCaches(const Scene& scene, const Atlas& atlas, CachePoints& points);

/// Appends the cache of a texel. The grid's caches come after all of these.
void addSurfaceCache(const Scene& scene, const AtlasTexel& texel, Caches& caches,
                     CachePoints& points);

/// Appends the caches of the grid's cells.
void addGridCaches(glm::uvec3 gridSize, const Bounds& gridBounds, Caches& caches,
                   CachePoints& points);

/// Gives every surfel its four caches: those of the bilinear lookup at its place in the lightmap,
/// on its side, which `lookup` snaps by rays of its own.
void connectSurfels(const SideLookup& lookup, const Scene& scene, const LightmapLayout& layout,
                    const Caches& caches, Surfels& surfels);

} // namespace limn
