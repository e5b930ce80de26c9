// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gltf/gltf_repairs.h"
#include "engine/scene/document.h"
#include "engine/scene/mesh/mesh.h"

#include <span>
#include <vector>

#include <tiny_gltf.h>

namespace limn {

/// Meshes of Assets that a glTF mesh became, one per drawable primitive.
using MeshesOfGltf = std::vector<std::vector<std::uint32_t>>;

/// Adds the nodes of the default scene, sets the document's origin by where they place `placed`,
/// the meshes of Assets, and adds the nodes' lights and cameras. Fails on cycles and on nodes with
/// two parents.
Result<void> addNodes(Document& document, const tinygltf::Model& model, const MeshesOfGltf& meshes,
                      std::span<const Mesh> placed, GltfRepairs& repairs);

/// Splits an affine matrix. Where that is not possible exactly (shear, a scale of 0) the nearest
/// Transform and a repair; false where a scale is 0, so that nothing under it can be seen.
bool decompose(const glm::mat4& m, Transform& transform, GltfRepairs& repairs);

} // namespace limn
