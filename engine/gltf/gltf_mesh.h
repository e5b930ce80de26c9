// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gltf/gltf_pose.h"
#include "engine/gltf/gltf_repairs.h"
#include "engine/scene/mesh/mesh.h"

#include <cstdint>
#include <optional>
#include <set>
#include <span>

#include <tiny_gltf.h>

namespace limn {

/// What of a primitive is read.
struct PrimitiveUse {
    std::set<std::uint32_t> uvSets; ///< that its material reads, besides TEXCOORD_0 and 1
    /// Set of the material's normal map, for which it needs tangents.
    std::optional<std::uint32_t> normalMapSet;
    std::span<const double> morphWeights; ///< of its targets
    const SkinPose* skin = nullptr;       ///< null, or whose joints move its vertices
};

/// Reads one primitive as triangles, with all guarantees of Mesh, and only the vertices that these
/// use. Morph targets are added with their weights, then
/// joints move the vertices. Returns an empty mesh if nothing drawable is
/// left. The caller sets the material index.
Result<Mesh> readPrimitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                           const PrimitiveUse& use, GltfRepairs& repairs);

} // namespace limn
