// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"
#include "engine/techniques/illuminance/relight/occlusion/blocker_shape.h"

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include <glm/mat3x3.hpp>

namespace limn {

/// A dynamic instance as it blocks light.
struct Blocker {
    std::shared_ptr<const BlockerShape> shape;
    glm::mat3 toObject{1}; ///< of directions, from the world
    glm::vec3 origin{0};   ///< world, of the object's space
    glm::vec3 centre{0};   ///< world, of a sphere about the mesh
    float radius = 0;      ///< [m]
    Bounds bounds;         ///< world, about the box
};

/// By mesh; kept between calls.
using BlockerShapes = std::map<std::uint32_t, std::shared_ptr<const BlockerShape>>;

/// Of the dynamic instances of `scene`; without those whose matrix has no inverse, which block
/// nothing. Adds to `shapes` those that are missing.
std::vector<Blocker> sceneBlockers(const Scene& scene, BlockerShapes& shapes);

/// Hash of all that sceneBlockers depends on but the meshes themselves. 0: there are none.
std::uint64_t hashBlockers(const Scene& scene);

} // namespace limn
