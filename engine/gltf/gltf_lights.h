// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gltf/gltf_repairs.h"
#include "engine/scene/document.h"

#include <cstddef>
#include <optional>
#include <span>

#include <tiny_gltf.h>

namespace limn {

/// Adds the lights of KHR_lights_punctual, EXT_lights_area and EXT_lights_ies and the perspective
/// camera of nodes[index], if it has them, in world space. `profiles` are those of EXT_lights_ies.
/// `toWorld` is the node's transform. All look down the node's -Z; its scale affects area lights
/// alone. A light that is not `visible` is off. Returns the index of the light of
/// KHR_lights_punctual, which is added first, if there is one.
std::optional<std::size_t> addLightAndCamera(Document& document, const tinygltf::Model& model,
                                             std::span<const ProfileRef> profiles,
                                             std::size_t index, const glm::mat4& toWorld,
                                             bool visible, GltfRepairs& repairs);

} // namespace limn
