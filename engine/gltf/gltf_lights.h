// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gltf/gltf_repairs.h"
#include "engine/scene/document.h"

#include <cstddef>

#include <tiny_gltf.h>

namespace limn {

/// Adds the lights of KHR_lights_punctual and EXT_lights_area and the perspective camera of
/// nodes[index], if it has them,
/// in world space. `toWorld` is the node's transform. Both look down the node's -Z; its scale
/// affects neither. A light that is not `visible` is off.
void addLightAndCamera(Document& document, const tinygltf::Model& model, std::size_t index,
                       const glm::mat4& toWorld, bool visible, GltfRepairs& repairs);

} // namespace limn
