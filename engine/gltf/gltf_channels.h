// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/animation.h"

#include <cstddef>
#include <optional>
#include <string>

#include <tiny_gltf.h>

namespace limn {

/// What a channel of an animation moves.
struct ChannelTarget {
    bool isLight = false;  ///< of KHR_lights_punctual; else a node
    std::size_t index = 0; ///< of that node or light, which exists
    std::string path;      ///< "translation", "intensity"
};

/// The target of a channel, by its node or by KHR_animation_pointer; std::nullopt: what is neither
/// a node nor a light.
std::optional<ChannelTarget> channelTarget(const tinygltf::Model& model,
                                           const tinygltf::AnimationChannel& channel);

/// Reads the keys of a channel of an animation. Fails on malformed samplers.
Result<KeyedValues> readKeys(const tinygltf::Model& model, const tinygltf::Animation& animation,
                             const tinygltf::AnimationChannel& channel);

} // namespace limn
