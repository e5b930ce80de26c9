// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gltf/gltf_nodes.h"
#include "engine/scene/animation.h"

#include <memory>

namespace limn {

/// The first animation of a file as far as it moves nodes that carry meshes, lights or cameras, and
/// lights, in the terms of the document that addNodes() filled. Null if it moves none. Skins and
/// morph weights are not in it. Fails on malformed samplers.
Result<std::shared_ptr<const SceneAnimation>>
readAnimation(const tinygltf::Model& model, const Document& document, const NodesOfGltf& nodes);

} // namespace limn
