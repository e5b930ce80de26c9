// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gltf/gltf_repairs.h"
#include "engine/scene/mesh/mesh.h"

#include <tiny_gltf.h>

namespace limn {

/// Reads one primitive as triangles, with all guarantees of Mesh. Returns an empty mesh if nothing
/// drawable is left. `withTangents` means that its material has a normal map. The caller sets the
/// material index.
Result<Mesh> readPrimitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                           bool withTangents, GltfRepairs& repairs);

} // namespace limn
