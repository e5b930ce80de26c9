// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/scene/camera.h"
#include "engine/techniques/radiance_volumes/cache_grids.h"
#include "engine/techniques/radiance_volumes/cache_place.h"
#include "engine/techniques/radiance_volumes/volume_settings.h"
#include "engine/trace/trace_scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace limn {

/// A point of a surface that a view shows.
struct ShownPoint {
    glm::vec3 position{0};
    glm::vec3 normal{0};    ///< unit, geometric, towards the eye
    std::uint32_t grid = 0; ///< of the finest grid that lights it
};

/// Caches where a view needs them.
struct CacheAllocation {
    CacheGrids grids;
    std::vector<std::uint32_t> address; ///< a cache or kNoCache for each node of each grid
    std::vector<CachePlace> places;     ///< of the caches
    std::vector<std::uint32_t> ofGrid;  ///< caches in each grid
    std::vector<glm::vec3> dropped;     ///< places of caches that were one too many, some of them
    std::size_t droppedCount = 0;       ///< number of all those
    std::size_t missed = 0;             ///< pixels that find no cache
    std::size_t pixels = 0;             ///< that show a surface; 0: of no view
    std::vector<ShownPoint> shown;      ///< some points of the view, evenly spread
    std::uint64_t rays = 0;

    std::size_t caches() const { return places.size(); }
    std::size_t bytes() const;
};

/// Which nodes of grids want a cache: 1 for each that does, in the order of the nodes of all grids.
using WantedNodes = std::vector<std::uint8_t>;

/// Wants the eight nodes of a cell. Several threads may do so at once.
void wantNodes(const CacheGrids& grids, std::size_t grid, glm::uvec3 cell, WantedNodes& wanted);

/// Numbers at most `caches` of the nodes that are wanted, those of coarse grids first, then in
/// their order; the others are dropped. Sets no more of the caches' places than their positions.
CacheAllocation numberCaches(const CacheGrids& grids, const WantedNodes& wanted,
                             std::size_t caches);

/// Middles of triangles of the scene, evenly spread over their numbers: CacheAllocation::shown
/// where there is no view.
std::vector<ShownPoint> middlesOfTriangles(const Scene& scene);

/// Size of the picture of a view; of a usual one where it has none.
glm::uvec2 pictureSize(const Viewpoint& view);

/// Caches for the pixels of a view: those of the nodes about what a ray through each pixel's middle
/// meets, in cascadesAbout() its eye. Incomplete when cancelled.
CacheAllocation allocateForView(const TraceScene& trace, const Scene& scene, const Viewpoint& view,
                                const VolumeSettings& settings, const Progress& progress = {});

/// Caches for all surfaces: the nodes of each cell that one touches, in the finest gridOver() the
/// scene that has room for them.
CacheAllocation allocateForScene(const Scene& scene, const VolumeSettings& settings);

} // namespace limn
