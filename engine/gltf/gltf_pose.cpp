// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_pose.h"

#include "engine/gltf/gltf_accessor.h"
#include "engine/gltf/gltf_value.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

namespace limn {

namespace {

constexpr const char* kPointer = "KHR_animation_pointer";

/// Keys of a sampler around a time.
struct Keys {
    std::size_t before = 0, after = 0;
    float share = 0;   ///< of the way from one to the other
    float seconds = 0; ///< between them
};

Keys keysAt(std::span<const float> times, float seconds) {
    const auto next = std::size_t(std::ranges::upper_bound(times, seconds) - times.begin());
    if (next == 0 || next == times.size()) {
        const std::size_t end = next == 0 ? 0 : times.size() - 1;
        return {end, end, 0, 0};
    }
    const float length = times[next] - times[next - 1];
    return {next - 1, next, length > 0 ? (seconds - times[next - 1]) / length : 0, length};
}

/// A sampler whose values have `width` numbers at each key.
struct KeyedValues {
    std::vector<float> times, values;
    bool steps = false, isCubic = false;

    std::size_t width() const { return values.size() / (times.size() * (isCubic ? 3 : 1)); }
    /// Values of a key; of a cubic spline 0 and 2 are its tangents.
    std::span<const float> at(std::size_t key, std::size_t part) const {
        const std::size_t w = width(), first = isCubic ? (3 * key + part) * w : key * w;
        return std::span(values).subspan(first, w);
    }
};

Result<KeyedValues> readKeyedValues(const tinygltf::Model& model,
                                    const tinygltf::AnimationSampler& source) {
    const Result<AccessorValues> input = readNumbers(model, source.input);
    if (!input)
        return fail("input: " + input.error().message);
    const Result<AccessorValues> output = readNumbers(model, source.output);
    if (!output)
        return fail("output: " + output.error().message);
    KeyedValues sampler{input->values, output->values, source.interpolation == "STEP",
                        source.interpolation == "CUBICSPLINE"};
    const std::size_t keys = sampler.times.size() * (sampler.isCubic ? 3 : 1);
    if (keys == 0 || !std::ranges::is_sorted(sampler.times))
        return fail("input: is not a list of times that ascend");
    if (sampler.values.size() < keys || sampler.values.size() % keys != 0)
        return fail(fmt::format("output: has {} numbers for {} keys", sampler.values.size(), keys));
    return sampler;
}

/// The values at a time. Rotations are interpolated on the sphere.
std::vector<double> valuesAt(const KeyedValues& sampler, float seconds, bool isRotation) {
    const Keys keys = keysAt(sampler.times, seconds);
    const std::size_t middle = sampler.isCubic ? 1 : 0;
    const std::span<const float> a = sampler.at(keys.before, middle),
                                 b = sampler.at(keys.after, middle);
    std::vector<double> out(a.begin(), a.end());
    if (sampler.steps || keys.before == keys.after)
        return out;
    const double t = double(keys.share);
    if (sampler.isCubic) { // Hermite's spline, whose tangents are per second
        const std::span<const float> leaving = sampler.at(keys.before, 2),
                                     arriving = sampler.at(keys.after, 0);
        const double d = double(keys.seconds), t2 = t * t, t3 = t2 * t;
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = (2 * t3 - 3 * t2 + 1) * double(a[i]) +
                     d * (t3 - 2 * t2 + t) * double(leaving[i]) + (3 * t2 - 2 * t3) * double(b[i]) +
                     d * (t3 - t2) * double(arriving[i]);
    } else if (isRotation && out.size() == 4) {
        const auto quaternion = [](std::span<const float> v) {
            return glm::dquat(glm::quat(v[3], v[0], v[1], v[2]));
        };
        const glm::dquat from = quaternion(a), to = quaternion(b);
        const glm::dquat q = glm::slerp(from, to, t);
        out = {q.x, q.y, q.z, q.w};
    } else {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] += t * (double(b[i]) - double(a[i]));
    }
    return out;
}

/// What a channel moves.
struct Target {
    std::vector<double>* values = nullptr; ///< of a node or a light
    double* number = nullptr;              ///< of a light
    std::size_t width = 0;                 ///< 0: any
    bool isRotation = false;
};

Target targetOfNode(tinygltf::Node& node, std::string_view path) {
    if (path == "translation")
        return {&node.translation, nullptr, 3, false};
    if (path == "rotation")
        return {&node.rotation, nullptr, 4, true};
    if (path == "scale")
        return {&node.scale, nullptr, 3, false};
    return path == "weights" ? Target{&node.weights, nullptr, 0, false} : Target();
}

Target targetOfLight(tinygltf::Light& light, std::string_view path) {
    if (path == "color")
        return {&light.color, nullptr, 3, false};
    if (path == "intensity")
        return {nullptr, &light.intensity, 1, false};
    return path == "range" ? Target{nullptr, &light.range, 1, false} : Target();
}

/// The target of a JSON pointer such as "/extensions/KHR_lights_punctual/lights/0/intensity".
Target targetOfPointer(tinygltf::Model& model, std::string_view pointer) {
    const auto under =
        [&](std::string_view prefix,
            std::size_t count) -> std::optional<std::pair<std::size_t, std::string_view>> {
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
        return std::pair(index, rest.substr(slash + 1));
    };
    if (const auto node = under("/nodes/", model.nodes.size()))
        return targetOfNode(model.nodes[node->first], node->second);
    if (const auto light = under("/extensions/KHR_lights_punctual/lights/", model.lights.size()))
        return targetOfLight(model.lights[light->first], light->second);
    return {};
}

Target targetOf(tinygltf::Model& model, const tinygltf::AnimationChannel& channel) {
    const auto pointer = channel.target_extensions.find(kPointer);
    if (pointer != channel.target_extensions.end()) {
        const tinygltf::Value* path = member(pointer->second, "pointer");
        return path && path->IsString() ? targetOfPointer(model, path->Get<std::string>())
                                        : Target();
    }
    if (channel.target_node < 0 || std::size_t(channel.target_node) >= model.nodes.size())
        return {};
    return targetOfNode(model.nodes[std::size_t(channel.target_node)], channel.target_path);
}

glm::dmat4 localMatrix(const tinygltf::Node& node) {
    glm::dmat4 m(1);
    if (node.matrix.size() == 16) {
        for (int i = 0; i < 16; ++i)
            m[i / 4][i % 4] = node.matrix[std::size_t(i)];
        return m;
    }
    glm::dquat q(1, 0, 0, 0);
    if (node.rotation.size() == 4)
        q = glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    if (const double length = glm::length(q); length > 0)
        m = glm::mat4_cast(q / length);
    for (int c = 0; c < 3; ++c) {
        if (node.scale.size() == 3)
            m[c] *= node.scale[std::size_t(c)];
        if (node.translation.size() == 3)
            m[3][c] = node.translation[std::size_t(c)];
    }
    return m;
}

/// World matrices of all nodes.
Result<std::vector<glm::dmat4>> worldMatrices(const tinygltf::Model& model) {
    std::vector<int> parent(model.nodes.size(), -1);
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        for (const int child : model.nodes[i].children)
            if (child >= 0 && std::size_t(child) < parent.size())
                parent[std::size_t(child)] = int(i);
    std::vector<glm::dmat4> world(model.nodes.size());
    std::vector<std::uint8_t> isKnown(model.nodes.size(), 0);
    std::vector<std::size_t> walk;
    for (std::size_t i = 0; i < world.size(); ++i) {
        walk.clear();
        for (int n = int(i); n >= 0 && !isKnown[std::size_t(n)]; n = parent[std::size_t(n)]) {
            walk.push_back(std::size_t(n));
            if (walk.size() > world.size())
                return fail(fmt::format("nodes[{}].children: the node is its own ancestor", n));
        }
        for (; !walk.empty(); walk.pop_back()) {
            const std::size_t n = walk.back();
            const glm::dmat4 local = localMatrix(model.nodes[n]);
            world[n] = parent[n] < 0 ? local : world[std::size_t(parent[n])] * local;
            isKnown[n] = 1;
        }
    }
    return world;
}

Result<SkinPose> poseOf(const tinygltf::Model& model, const tinygltf::Skin& skin,
                        const std::vector<glm::dmat4>& world) {
    SkinPose pose;
    AccessorValues bind;
    if (skin.inverseBindMatrices >= 0) {
        Result<AccessorValues> values = readNumbers(model, skin.inverseBindMatrices);
        if (!values || values->components != 16 || values->count() < skin.joints.size())
            return fail(fmt::format("inverseBindMatrices: {}",
                                    values ? "not a MAT4 for each joint" : values.error().message));
        bind = std::move(*values);
    }
    for (std::size_t k = 0; k < skin.joints.size(); ++k) {
        const int joint = skin.joints[k];
        if (joint < 0 || std::size_t(joint) >= world.size())
            return fail(fmt::format("joints[{}]: {} is out of range", k, joint));
        glm::dmat4 inverse(1);
        for (int i = 0; i < 16 && bind.count() > 0; ++i)
            inverse[i / 4][i % 4] = double(bind.row(k)[std::size_t(i)]);
        pose.joints.push_back(world[std::size_t(joint)] * inverse);
    }
    if (!pose.joints.empty())
        pose.origin = glm::dvec3(pose.joints[0][3]);
    for (glm::dmat4& joint : pose.joints)
        joint[3] -= glm::dvec4(pose.origin, 0);
    return pose;
}

} // namespace

Result<void> poseAt(tinygltf::Model& model, double seconds, GltfRepairs& repairs) {
    if (model.animations.empty())
        return {};
    repairs.add("animations after the first left out", model.animations.size() - 1);
    const tinygltf::Animation& animation = model.animations[0];
    for (std::size_t c = 0; c < animation.channels.size(); ++c) {
        const tinygltf::AnimationChannel& channel = animation.channels[c];
        const auto failAt = [&](const std::string& message) {
            return fail(fmt::format("animations[0].channels[{}].{}", c, message));
        };
        if (channel.sampler < 0 || std::size_t(channel.sampler) >= animation.samplers.size())
            return failAt("sampler: out of range");
        const Target target = targetOf(model, channel);
        if (!target.values && !target.number) {
            repairs.add("animated properties that stay as they are");
            continue;
        }
        const Result<KeyedValues> sampler =
            readKeyedValues(model, animation.samplers[std::size_t(channel.sampler)]);
        if (!sampler)
            return failAt("sampler: " + sampler.error().message);
        const std::vector<double> values = valuesAt(*sampler, float(seconds), target.isRotation);
        if (target.width > 0 && values.size() != target.width)
            return failAt(fmt::format("sampler: its values have {} numbers", values.size()));
        if (target.number)
            *target.number = values[0];
        else
            *target.values = values;
    }
    return {};
}

Result<std::vector<SkinPose>> skinPoses(const tinygltf::Model& model) {
    std::vector<SkinPose> poses(model.nodes.size());
    if (model.skins.empty())
        return poses;
    const Result<std::vector<glm::dmat4>> world = worldMatrices(model);
    if (!world)
        return tl::make_unexpected(world.error());
    for (std::size_t n = 0; n < poses.size(); ++n) {
        const int skin = model.nodes[n].skin;
        if (model.nodes[n].mesh < 0 || skin < 0 || std::size_t(skin) >= model.skins.size())
            continue;
        Result<SkinPose> pose = poseOf(model, model.skins[std::size_t(skin)], *world);
        if (!pose)
            return fail(fmt::format("skins[{}].{}", skin, pose.error().message));
        poses[n] = std::move(*pose);
    }
    return poses;
}

} // namespace limn
