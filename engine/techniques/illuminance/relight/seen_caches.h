// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/camera.h"
#include "engine/techniques/illuminance/relight/caches/cache_runs.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace limn {

/// A part of a surface, within one chart, whose lookups read a cache.
struct CacheFootprint {
    Bounds bounds; ///< world
    /// Unit, world: the normals of its triangles, on the side that reads the cache, lie within an
    /// angle of it. 0: it may be seen from anywhere.
    glm::vec3 normal{0};
    float cosSpread = 1; ///< of that angle
};

/// The footprints of each lightmap cache: those of cache c are footprints[begin[c] … begin[c + 1]).
struct CacheFootprints {
    std::vector<std::uint32_t> begin;
    std::vector<CacheFootprint> footprints;
};

/// Computes the footprints from every triangle that has a lightmap, clipped to the reach of each
/// texel it looks up, including bilinear weights up to 1/256 of a texel beyond. `scene` has the
/// bake's static geometry.
CacheFootprints cacheFootprints(const Scene& scene, const Bake& bake);

/// The lightmap caches that a picture of `camera` may look up, ignoring occlusion: those with a
/// footprint that meets the field of view, widened by 2 %, and does not face away from the eye, and
/// those without any footprint. `aspect`: width over height.
CacheFlags seenCaches(const CacheFootprints& footprints, const Camera& camera, float aspect);

/// Caches of one bake that are seen from the latest viewpoint.
struct SeenFrom {
    CacheFootprints footprints; ///< empty until needed
    std::optional<Viewpoint> view;
    CacheFlags seen; ///< from `view`
};

/// Brings `from` up to date with `view` and returns its caches. Every call must pass the same
/// `scene` and `bake`.
const CacheFlags& seenFrom(SeenFrom& from, const Scene& scene, const Bake& bake,
                           const Viewpoint& view);

} // namespace limn
