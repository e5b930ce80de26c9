// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_animation.h"

#include "engine/gltf/gltf_channels.h"
#include "engine/scene/find_object.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>

#include <fmt/format.h>

namespace limn {

static std::optional<AnimatedProperty> propertyOf(const ChannelTarget& target) {
    using Named = std::pair<std::string_view, AnimatedProperty>;
    constexpr Named kOfNodes[] = {{"translation", AnimatedProperty::Translation},
                                  {"rotation", AnimatedProperty::Rotation},
                                  {"scale", AnimatedProperty::Scale}},
                    kOfLights[] = {{"color", AnimatedProperty::Color},
                                   {"intensity", AnimatedProperty::Strength},
                                   {"range", AnimatedProperty::Range}};
    for (const auto& [name, property] : target.isLight ? kOfLights : kOfNodes)
        if (target.path == name)
            return property;
    return std::nullopt;
}

/// Nodes that carry something which is seen or shines, and what carries these.
static std::set<ObjectId> carriers(const Document& document, const NodesOfGltf& nodes) {
    std::set<ObjectId> result;
    const auto add = [&](ObjectId id) {
        while (id != 0 && result.insert(id).second) {
            const Node* node = findObjectAs<Node>(document, id);
            id = node ? node->parent : 0;
        }
    };
    for (const auto& [id, object] : document.objects)
        if (const Node* node = std::get_if<Node>(&object); node && !node->meshes.empty())
            add(id);
    for (const CarriedObject& carried : nodes.carried)
        add(carried.node);
    return result;
}

Result<std::shared_ptr<const SceneAnimation>>
readAnimation(const tinygltf::Model& model, const Document& document, const NodesOfGltf& nodes) {
    if (model.animations.empty())
        return std::shared_ptr<const SceneAnimation>();
    auto result = std::make_shared<SceneAnimation>();
    const std::set<ObjectId> seen = carriers(document, nodes);
    const tinygltf::Animation& animation = model.animations[0];
    for (std::size_t c = 0; c < animation.channels.size(); ++c) {
        const std::optional<ChannelTarget> target = channelTarget(model, animation.channels[c]);
        const std::optional<AnimatedProperty> property =
            target ? propertyOf(*target) : std::nullopt;
        if (!property)
            continue;
        std::vector<ObjectId> objects;
        if (target->isLight)
            objects = nodes.lights[target->index];
        else if (seen.contains(nodes.ids[target->index]))
            objects = {nodes.ids[target->index]};
        if (objects.empty())
            continue;
        const Result<KeyedValues> keys = readKeys(model, animation, animation.channels[c]);
        if (!keys)
            return fail(fmt::format("animations[0].channels[{}].{}", c, keys.error().message));
        for (const ObjectId object : objects)
            result->tracks.push_back({object, *property, *keys});
    }
    result->carried = nodes.carried;
    if (result->tracks.empty())
        result.reset();
    return std::shared_ptr<const SceneAnimation>(std::move(result));
}

} // namespace limn
