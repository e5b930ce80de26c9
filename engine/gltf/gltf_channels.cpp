// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_channels.h"

#include "engine/gltf/gltf_accessor.h"
#include "engine/gltf/gltf_value.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace limn {

static constexpr const char* kPointer = "KHR_animation_pointer";

/// The number and the rest of a JSON pointer below a prefix, if fewer than `count` is the number.
static std::optional<ChannelTarget> below(std::string_view pointer, std::string_view prefix,
                                          std::size_t count) {
    if (!pointer.starts_with(prefix))
        return {};
    const std::string_view rest = pointer.substr(prefix.size());
    const std::size_t slash = rest.find('/');
    std::size_t index = 0;
    for (const char c : rest.substr(0, slash)) {
        if (c < '0' || c > '9' || index > count)
            return {};
        index = 10 * index + std::size_t(c - '0');
    }
    if (slash == 0 || slash == std::string_view::npos || index >= count)
        return {};
    return ChannelTarget{false, index, std::string(rest.substr(slash + 1))};
}

/// The target of a JSON pointer such as "/extensions/KHR_lights_punctual/lights/0/intensity".
static std::optional<ChannelTarget> targetOfPointer(const tinygltf::Model& model,
                                                    std::string_view pointer) {
    if (auto node = below(pointer, "/nodes/", model.nodes.size()))
        return node;
    auto light = below(pointer, "/extensions/KHR_lights_punctual/lights/", model.lights.size());
    if (light)
        light->isLight = true;
    return light;
}

std::optional<ChannelTarget> channelTarget(const tinygltf::Model& model,
                                           const tinygltf::AnimationChannel& channel) {
    const auto pointer = channel.target_extensions.find(kPointer);
    if (pointer != channel.target_extensions.end()) {
        const tinygltf::Value* path = member(pointer->second, "pointer");
        if (!path || !path->IsString())
            return {};
        return targetOfPointer(model, path->Get<std::string>());
    }
    if (channel.target_node < 0 || std::size_t(channel.target_node) >= model.nodes.size())
        return {};
    return ChannelTarget{false, std::size_t(channel.target_node), channel.target_path};
}

Result<KeyedValues> readKeys(const tinygltf::Model& model, const tinygltf::Animation& animation,
                             const tinygltf::AnimationChannel& channel) {
    if (channel.sampler < 0 || std::size_t(channel.sampler) >= animation.samplers.size())
        return fail("sampler: out of range");
    const tinygltf::AnimationSampler& source = animation.samplers[std::size_t(channel.sampler)];
    const Result<AccessorValues> input = readNumbers(model, source.input);
    if (!input)
        return fail("sampler: input: " + input.error().message);
    const Result<AccessorValues> output = readNumbers(model, source.output);
    if (!output)
        return fail("sampler: output: " + output.error().message);
    KeyedValues keys{input->values, output->values,
                     source.interpolation == "STEP"          ? Interpolation::Step
                     : source.interpolation == "CUBICSPLINE" ? Interpolation::CubicSpline
                                                             : Interpolation::Linear};
    const std::size_t count =
        keys.times.size() * (keys.interpolation == Interpolation::CubicSpline ? 3 : 1);
    if (count == 0 || !std::ranges::is_sorted(keys.times))
        return fail("sampler: input: is not a list of times that ascend");
    if (keys.values.size() < count || keys.values.size() % count != 0)
        return fail(
            fmt::format("sampler: output: has {} numbers for {} keys", keys.values.size(), count));
    return keys;
}

} // namespace limn
