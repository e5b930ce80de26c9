// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_pose.h"

#include "engine/gltf/gltf_accessor.h"
#include "engine/gltf/gltf_channels.h"

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

Target targetOf(tinygltf::Model& model, const tinygltf::AnimationChannel& channel) {
    const std::optional<ChannelTarget> target = channelTarget(model, channel);
    if (!target)
        return {};
    return target->isLight ? targetOfLight(model.lights[target->index], target->path)
                           : targetOfNode(model.nodes[target->index], target->path);
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
        const Target target = targetOf(model, channel);
        if (!target.values && !target.number) {
            repairs.add("animated properties that stay as they are");
            continue;
        }
        const Result<KeyedValues> keys = readKeys(model, animation, channel);
        if (!keys)
            return failAt(keys.error().message);
        const std::vector<double> values = valuesAt(*keys, seconds, target.isRotation);
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
