// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gltf/gltf_repairs.h"
#include "engine/scene/mesh/mesh.h"

#include <tiny_gltf.h>

namespace limn {

/// One primitive as triangles, with all that Mesh guarantees. Empty where nothing drawable is left.
/// `withTangents`: its material has a normal map. The material index is the caller's to set.
Result<Mesh> readPrimitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                           bool withTangents, GltfRepairs& repairs);

} // namespace limn
