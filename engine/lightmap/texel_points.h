// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/atlas.h"
#include "engine/scene/scene.h"

#include <cstdint>

namespace limn {

/// A point of an instance in world space.
struct WorldPoint {
    glm::vec3 position, normal; ///< unit geometric normal of the front
};
WorldPoint worldPoint(const Scene& scene, const Instance& instance, const MeshPoint& point);

/// Point k of a texel, with the normal of the side that the texel represents.
WorldPoint texelPoint(const Scene& scene, const AtlasTexel& texel, std::uint32_t k);

/// Seed that rotates a texel's ray directions. It depends on the position in the mesh only, so a
/// texel keeps its rays when objects are added, removed or moved.
std::uint32_t seedOf(const Scene& scene, const AtlasTexel& texel);

} // namespace limn
