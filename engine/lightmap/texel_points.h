// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/atlas.h"
#include "engine/scene/scene.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>

namespace limn {

/// A point of an instance in world space.
struct WorldPoint {
    glm::vec3 position, normal; ///< unit geometric normal
};
/// The normal is that of the front or, where `back`, of the back.
WorldPoint worldPoint(const Scene& scene, const Instance& instance, const MeshPoint& point,
                      bool back = false);

/// Point k of a texel, with the normal of the side that the texel represents.
WorldPoint texelPoint(const Scene& scene, const AtlasTexel& texel, std::uint32_t k);

/// A point above a surface, from which segments along the surface start.
struct RaisedPoint {
    glm::vec3 position;
    bool covered; ///< whether a static surface lies closely above
};

/// The ray that raise() traces: from a point, clear of its surface, to twice `height` [m] above it.
Ray rayAbove(const TraceScene& trace, const WorldPoint& point, float height);

/// Raises a point by `height` [m], or half way to the next static surface above where that is
/// closer than twice the height, so that no thin object closely above is jumped over. Traces one
/// ray.
RaisedPoint raise(const TraceScene& trace, const WorldPoint& point, float height);

/// Seed that rotates a texel's ray directions. It depends on the position in the mesh only, so a
/// texel keeps its rays when objects are added, removed or moved.
std::uint32_t seedOf(const Scene& scene, const AtlasTexel& texel);

} // namespace limn
