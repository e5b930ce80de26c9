// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/atlas.h"
#include "engine/scene/scene.h"

#include <cstdint>

namespace limn {

/// A point of an instance in the world.
struct WorldPoint {
    glm::vec3 position, normal; ///< unit geometric normal of the front
};
WorldPoint worldPoint(const Scene& scene, const Instance& instance, const MeshPoint& point);

/// Point k of a texel, with the normal of the side it stands for.
WorldPoint texelPoint(const Scene& scene, const AtlasTexel& texel, std::uint32_t k);

/// Turns the ray directions of a texel. It depends on the place in the mesh, so that a texel keeps
/// its rays when objects come, go or move.
std::uint32_t seedOf(const Scene& scene, const AtlasTexel& texel);

} // namespace limn
