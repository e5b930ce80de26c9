// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/texel_points.h"
#include "engine/techniques/illuminance/bake/bake.h"

namespace limn {

class SideLookup;

/// Where a cache's rays start: ray r leaves points[r mod count], about that point's normal. A cache
/// so gathers over the whole surface its texel stands for, folds and edges included, and the points
/// that lie in a wall can be left out.
struct CachePoints {
    std::vector<std::uint32_t> begin;        ///< caches + 1 offsets
    std::vector<glm::vec3> position, normal; ///< world; normal 0 for Grid
    /// Per cache: turns its ray directions. Of the place in the mesh or the grid, so that a cache
    /// keeps its rays when objects come, go or move.
    std::vector<std::uint32_t> seed;
};

/// The caches of an atlas' texels: kind, mean position, mean normal and texel are filled.
Caches placeCaches(const Scene& scene, const Atlas& atlas, CachePoints& points);

/// Appends the cache of a texel. Those of the grid come after all of these.
void addSurfaceCache(const Scene& scene, const AtlasTexel& texel, Caches& caches,
                     CachePoints& points);

/// Appends those of the grid's cells.
void addGridCaches(glm::uvec3 gridSize, const Bounds& gridBounds, Caches& caches,
                   CachePoints& points);

/// Cells of the grid: settings.grid; or, where that is 0 and some instance has no lightmap, cubes
/// of about 1/12 of the longest side, at most 32 a side; or none.
glm::uvec3 chooseGridSize(const Scene& scene, const LightmapLayout& layout,
                          const BakeSettings& settings);

/// Those of the static scene, never empty in any direction: a dynamic object may move beyond them,
/// and reads the nearest cells there.
Bounds gridBoundsOf(const Scene& scene);

/// Gives every surfel its four caches: the bilinear lookup at its side's place in the lightmap,
/// snapped by rays of its own.
void connectSurfels(const SideLookup& lookup, const Scene& scene, const LightmapLayout& layout,
                    const Caches& caches, Surfels& surfels);

} // namespace limn
