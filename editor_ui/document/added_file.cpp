// SPDX-License-Identifier: MIT
#include "editor_ui/document/added_file.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/material_edit.h"
#include "editor_ui/editor_state.h"
#include "engine/scene/origin.h"
#include "engine/scene/surface/material_textures.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

namespace limn {

const AssetFile* findAssetFile(const Document& document, const std::string& path) {
    const auto found = std::ranges::find(document.files, path, &AssetFile::path);
    return found == document.files.end() ? nullptr : &*found;
}

void takeAssets(EditorState& state, AddedAssets& added, std::vector<Bounds> meshBounds) {
    state.assets = std::move(added.assets);
    state.meshBounds = std::move(meshBounds);
    state.document.files.push_back(added.file);
}

void addShape(EditorState& state, const AssetFile& shape, const Transform& place) {
    commitGesture(state);
    const std::string kind = state.assets->meshes[shape.firstMesh].name;
    Material material = greyMaterial(freeName(state.document, kind + " material"));
    const ObjectId materialId = state.document.nextId, id = materialId + 1;
    Node node;
    node.name = freeName(state.document, kind);
    node.transform = place;
    node.transform.translation += state.document.origin;
    node.meshes = {shape.firstMesh};
    node.materials = {materialId};
    Edit edit{"Add " + node.name, {}};
    edit.changes.push_back({materialId, {}, std::move(material)});
    edit.changes.push_back({id, {}, std::move(node)});
    applyEdit(state, std::move(edit));
    state.selection = {id};
}

namespace {

/// Turns objects of a glTF into those of a document that has its assets.
struct Adoption {
    const AssetFile& file;
    const ImportedScene& imported;
    const glm::dvec3& origin;             ///< of the document
    ObjectId group = 0;                   ///< parent of the file's roots
    std::map<ObjectId, ObjectId> ids;     ///< of the file's objects, in the document
    std::vector<ObjectId> materials = {}; ///< in the document, as Mesh::material counts them

    void adopt(Node& node, const std::vector<Mesh>& meshes) const {
        node.parent = node.parent ? ids.at(node.parent) : group;
        for (std::uint32_t& mesh : node.meshes) {
            mesh += file.firstMesh;
            const std::uint32_t material = meshes[mesh].material;
            node.materials.push_back(material < materials.size() ? materials[material] : 0);
        }
    }
    void adopt(Material& material) const {
        for (TextureRef* texture : texturesOf(material))
            if (texture->image >= 0)
                texture->image += std::int32_t(file.firstImage);
    }
    void adopt(Light& light) const {
        light.position = toWorld(origin, toFile(imported.document.origin, light.position));
    }
};

} // namespace

void addScene(EditorState& state, const AssetFile& file, const ImportedScene& imported) {
    commitGesture(state);
    Node group;
    group.name = freeName(state.document, std::filesystem::path(file.path).stem().string());
    ObjectId next = state.document.nextId;
    Adoption to{file, imported, state.document.origin, next++, {}};
    for (const auto& [id, object] : imported.document.objects)
        if (std::holds_alternative<Node>(object) || std::holds_alternative<Material>(object) ||
            std::holds_alternative<Light>(object)) {
            if (std::holds_alternative<Material>(object))
                to.materials.push_back(next);
            to.ids.emplace(id, next++);
        }
    Edit edit{"Add " + group.name, {}};
    state.selection.clear();
    edit.changes.push_back({to.group, {}, std::move(group)});
    for (const auto& [id, now] : to.ids) {
        Object object = imported.document.objects.at(id);
        if (Node* node = std::get_if<Node>(&object))
            to.adopt(*node, state.assets->meshes);
        else if (Material* material = std::get_if<Material>(&object))
            to.adopt(*material);
        else if (Light* light = std::get_if<Light>(&object)) {
            to.adopt(*light);
            state.selection.push_back(now); // a light has no parent: it moves by being selected
        }
        edit.changes.push_back({now, {}, std::move(object)});
    }
    applyEdit(state, std::move(edit));
    state.selection.push_back(to.group);
}

} // namespace limn
