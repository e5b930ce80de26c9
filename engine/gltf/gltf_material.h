// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gltf/gltf_repairs.h"
#include "engine/scene/surface/material.h"

#include <tiny_gltf.h>

namespace limn {

/// Reads materials[index]. Numbers out of range are clamped and reported.
Material readMaterial(const tinygltf::Model& model, std::size_t index, GltfRepairs& repairs);

} // namespace limn
