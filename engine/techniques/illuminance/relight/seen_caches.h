// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/camera.h"
#include "engine/techniques/illuminance/relight/caches/cache_runs.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace limn {

/// A part of a surface that looks a cache up, within one chart.
struct CacheFootprint {
    Bounds bounds; ///< world
    /// Unit, world: the sides in question of its triangles look along it, up to an angle. 0: it may
    /// be seen from anywhere.
    glm::vec3 normal{0};
    float cosSpread = 1; ///< of that angle
};

/// Of each lightmap cache; of cache c footprints[begin[c] … begin[c + 1]).
struct CacheFootprints {
    std::vector<std::uint32_t> begin;
    std::vector<CacheFootprint> footprints;
};

/// From every triangle that has a lightmap, cut to the reach of each texel it looks up, bilinear
/// weights of 1/256 of a texel beyond included. Of a scene with the bake's static geometry.
CacheFootprints cacheFootprints(const Scene& scene, const Bake& bake);

/// The lightmap caches that a picture of `camera` may look up, objects that hide others left aside:
/// those with a footprint that meets the field of view, widened by 2 %, and does not turn its back
/// on the eye; and those without any. `aspect`: width over height.
CacheFlags seenCaches(const CacheFootprints& footprints, const Camera& camera, float aspect);

/// What is seen of one bake from the newest viewpoint.
struct SeenFrom {
    CacheFootprints footprints; ///< empty until needed
    std::optional<Viewpoint> view;
    CacheFlags seen; ///< from there
};

/// Brings `from` up to date and returns its caches. `scene` and `bake` are always the same.
const CacheFlags& seenFrom(SeenFrom& from, const Scene& scene, const Bake& bake,
                           const Viewpoint& view);

} // namespace limn
