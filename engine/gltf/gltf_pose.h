// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gltf/gltf_repairs.h"

#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <tiny_gltf.h>

namespace limn {

/// Moves nodes, morph weights and lights to where the file's first animation has them after some
/// seconds. Before its first and after its last key, a channel keeps its value (glTF 2.0). Reports
/// further animations and channels of what cannot be moved. Fails on malformed samplers.
Result<void> poseAt(tinygltf::Model& model, double seconds, GltfRepairs& repairs);

/// Joints of a skinned node, as its vertices need them.
struct SkinPose {
    std::vector<glm::dmat4> joints; ///< from the mesh to the world, less `origin`
    glm::dvec3 origin{0};           ///< where the skinned mesh is placed
};

/// The pose of each node's skin; without joints where it has none. Fails on malformed skins, and on
/// cycles of nodes.
Result<std::vector<SkinPose>> skinPoses(const tinygltf::Model& model);

} // namespace limn
