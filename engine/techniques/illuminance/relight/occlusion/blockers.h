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
    glm::mat3 toObject{1}; ///< transforms directions from world to object space
    glm::vec3 origin{0};   ///< world position of the object space's origin
    glm::vec3 centre{0};   ///< world, of a sphere that encloses the mesh
    float radius = 0;      ///< [m]
    Bounds bounds;         ///< world, of the box
};

/// Shapes by mesh, kept between calls.
using BlockerShapes = std::map<std::uint32_t, std::shared_ptr<const BlockerShape>>;

/// Blockers of the dynamic instances of `scene`, except those whose matrix has no inverse, which
/// block nothing. Adds missing shapes to `shapes`.
std::vector<Blocker> sceneBlockers(const Scene& scene, BlockerShapes& shapes);

/// Hash of everything that sceneBlockers() depends on except the meshes themselves; 0 where there
/// are no blockers.
std::uint64_t hashBlockers(const Scene& scene);

} // namespace limn
