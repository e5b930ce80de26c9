// SPDX-License-Identifier: MIT
#include "editor_ui/document/material_edit.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/editor_state.h"
#include "engine/scene/find_object.h"
#include "engine/scene/surface/material_textures.h"

#include <algorithm>
#include <set>
#include <utility>

namespace limn {

const char* textureSlotName(TextureSlot slot) {
    switch (slot) {
    case TextureSlot::BaseColor:
        return "Base colour";
    case TextureSlot::MetallicRoughness:
        return "Metal, roughness";
    case TextureSlot::Normal:
        return "Normal";
    case TextureSlot::Emissive:
        return "Emission";
    }
    return "";
}

TextureRef& textureIn(Material& material, TextureSlot slot) {
    return *texturesOf(material)[std::size_t(slot)];
}

ObjectId materialOf(const EditorState& state, const Node& node, std::size_t mesh) {
    if (mesh < node.materials.size() &&
        findObjectAs<Material>(state.document, node.materials[mesh]))
        return node.materials[mesh];
    if (mesh >= node.meshes.size() || node.meshes[mesh] >= state.assets->meshes.size())
        return 0;
    std::uint32_t left = state.assets->meshes[node.meshes[mesh]].material;
    for (const auto& [id, object] : state.document.objects)
        if (std::holds_alternative<Material>(object) && left-- == 0)
            return id;
    return 0;
}

/// The changes by which the nodes get the material.
static std::vector<Change> assignments(const EditorState& state, const std::vector<ObjectId>& nodes,
                                       ObjectId material, std::optional<std::uint32_t> mesh) {
    std::vector<Change> changes;
    for (ObjectId id : nodes) {
        const Node* node = findObjectAs<Node>(state.document, id);
        if (!node || node->meshes.empty())
            continue;
        Node after = *node;
        after.materials.resize(node->meshes.size());
        for (std::size_t m = 0; m < node->meshes.size(); ++m)
            if ((!mesh || node->meshes[m] == *mesh) && materialOf(state, *node, m) != material)
                after.materials[m] = material;
        const bool same =
            std::ranges::equal(after.materials,
                               node->materials) || // all zeros say what an empty list says
            (node->materials.empty() &&
             std::set(after.materials.begin(), after.materials.end()) == std::set<ObjectId>{0});
        if (!same)
            changes.push_back({id, *node, std::move(after)});
    }
    return changes;
}

void assignMaterial(EditorState& state, const std::vector<ObjectId>& nodes, ObjectId material,
                    std::optional<std::uint32_t> mesh) {
    commitGesture(state);
    const auto* given = findObjectAs<Material>(state.document, material);
    if (given)
        applyEdit(state, {"Assign " + given->name, assignments(state, nodes, material, mesh)});
}

Material greyMaterial(std::string name) {
    Material material;
    material.name = std::move(name);
    material.baseColor = {0.5f, 0.5f, 0.5f, 1};
    return material;
}

ObjectId assignNewMaterial(EditorState& state, const std::vector<ObjectId>& nodes,
                           ObjectId original, std::optional<std::uint32_t> mesh) {
    commitGesture(state);
    Material material = greyMaterial("Material");
    if (const auto* copied = findObjectAs<Material>(state.document, original))
        material = *copied;
    material.name = freeName(state.document, material.name);
    const ObjectId id = state.document.nextId;
    Edit edit{"Add " + material.name, assignments(state, nodes, id, mesh)};
    edit.changes.insert(edit.changes.begin(), Change{id, {}, std::move(material)});
    applyEdit(state, std::move(edit));
    return id;
}

void setTexture(EditorState& state, ObjectId id, TextureSlot slot, std::int32_t image) {
    commitGesture(state);
    const auto* material = findObjectAs<Material>(state.document, id);
    if (!material)
        return;
    Material after = *material;
    if (textureIn(after, slot).image == image)
        return;
    textureIn(after, slot) = {};
    textureIn(after, slot).image = image;
    if (slot == TextureSlot::Emissive) {
        after.emissiveFlipbook = {};
        if (image >= 0 && after.emission == glm::vec3(0))
            after.emission = glm::vec3(1);
    }
    const char* verb = image < 0 ? "Remove texture of " : "Texture of ";
    applyEdit(state, {verb + material->name, {{id, *material, std::move(after)}}});
}

} // namespace limn
