// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gltf/gltf_pose.h"
#include "engine/gltf/gltf_repairs.h"
#include "engine/scene/animation.h"
#include "engine/scene/document.h"
#include "engine/scene/mesh/mesh.h"

#include <span>
#include <vector>

#include <tiny_gltf.h>

namespace limn {

/// The meshes of Assets that glTF meshes became, one per drawable primitive.
struct MeshesOfGltf {
    /// For each glTF mesh, then for each of its other morph weights.
    std::vector<std::vector<std::uint32_t>> parts;
    std::vector<std::uint32_t> partsOfNode; ///< per node: which of them, where it has a mesh

    const std::vector<std::uint32_t>& of(std::size_t node) const {
        return parts[partsOfNode[node]];
    }
};

/// The objects that nodes of a file became.
struct NodesOfGltf {
    std::vector<ObjectId> ids;                 ///< per node; 0: not in the scene
    std::vector<CarriedObject> carried;        ///< lights and cameras
    std::vector<std::vector<ObjectId>> lights; ///< per light of KHR_lights_punctual
};

/// Adds the nodes of the default scene with their lights and cameras, and sets the document's
/// origin from where the nodes place `placed`, the meshes of Assets. Fails on cycles and on nodes
/// with two parents.
/// `skins` are per node, `profiles` per light of EXT_lights_ies.
Result<NodesOfGltf> addNodes(Document& document, const tinygltf::Model& model,
                             const MeshesOfGltf& meshes, std::span<const SkinPose> skins,
                             std::span<const ProfileRef> profiles, std::span<const Mesh> placed,
                             GltfRepairs& repairs);

/// Decomposes an affine matrix. If that is not possible exactly (shear, a scale of 0), stores the
/// nearest Transform and reports a repair. Returns false if a scale is 0, so that nothing under the
/// node is visible.
bool decompose(const glm::mat4& m, Transform& transform, GltfRepairs& repairs);

} // namespace limn
