// SPDX-License-Identifier: MIT
#include "editor_ui/panels/material_choice.h"

#include "editor_ui/document/material_edit.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/panels/field.h"
#include "engine/scene/find_object.h"

#include <imgui.h>

#include <cstring>
#include <set>
#include <string>

namespace limn {

static constexpr const char* kMaterial = "material";

/// Materials of the meshes that the choice is about; 0: none of the document's.
static std::set<ObjectId> materialsNow(const EditorState& state, const std::vector<ObjectId>& nodes,
                                       std::optional<std::uint32_t> mesh) {
    std::set<ObjectId> materials;
    for (ObjectId id : nodes)
        if (const Node* node = findObjectAs<Node>(state.document, id))
            for (std::size_t m = 0; m < node->meshes.size(); ++m)
                if (!mesh || node->meshes[m] == *mesh)
                    materials.insert(materialOf(state, *node, m));
    return materials;
}

static std::string shownName(const EditorState& state, const std::set<ObjectId>& materials) {
    if (materials.size() > 1)
        return std::to_string(materials.size()) + " materials";
    const auto* material = findObjectAs<Material>(state.document, *materials.begin());
    return material ? material->name : "none";
}

static void materialList(EditorState& state, const std::vector<ObjectId>& nodes,
                         std::optional<std::uint32_t> mesh, const std::set<ObjectId>& now) {
    ObjectId chosen = 0;
    for (const auto& [id, object] : state.document.objects)
        if (const auto* material = std::get_if<Material>(&object)) {
            ImGui::PushID(int(id));
            const bool current = now.size() == 1 && *now.begin() == id;
            if (ImGui::Selectable("##choice", current))
                chosen = id;
            ImGui::SameLine(0, 0);
            elidedText(material->name, ImGui::GetFontSize() * 24);
            ImGui::PopID();
        }
    if (chosen)
        assignMaterial(state, nodes, chosen, mesh);
}

void materialChoice(EditorState& state, const std::vector<ObjectId>& nodes,
                    std::optional<std::uint32_t> mesh) {
    const std::set<ObjectId> now = materialsNow(state, nodes, mesh);
    if (now.empty())
        return;
    ImGui::PushID(mesh ? int(*mesh) : -1);
    if (now.size() > 1)
        markMixed();
    fieldLabel(mesh ? "Its material" : "Material",
               mesh ? "Material of the part that was clicked; a bake is needed only where it has "
                      "other holes or sides"
                    : "Material of all parts of the selected objects. One can also be dragged here "
                      "from the list on the left");
    const std::string name = shownName(state, now);
    const float room = ImGui::CalcItemWidth() - ImGui::GetFrameHeight();
    if (ImGui::BeginCombo("##material", elided(name, room - 8).c_str())) {
        materialList(state, nodes, mesh, now);
        ImGui::EndCombo();
    }
    wrappedTooltip(name.c_str());
    if (const ObjectId dropped = droppedMaterial())
        assignMaterial(state, nodes, dropped, mesh);
    fieldLabel("", "");
    const bool one = now.size() == 1 && *now.begin() != 0;
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const ImVec2 size((ImGui::GetContentRegionAvail().x - 2 * gap) / 3, 0);
    if (ImGui::Button("New", size))
        assignNewMaterial(state, nodes, 0, mesh);
    wrappedTooltip("Assigns a new grey material");
    ImGui::SameLine(0, gap);
    ImGui::BeginDisabled(!one);
    if (ImGui::Button("Copy", size))
        assignNewMaterial(state, nodes, *now.begin(), mesh);
    wrappedTooltip("Assigns a copy of this material, so that other objects keep theirs");
    ImGui::SameLine(0, gap);
    if (ImGui::Button("Edit", size))
        state.selection = {*now.begin()};
    wrappedTooltip("Selects the material");
    ImGui::EndDisabled();
    ImGui::PopID();
}

void dragMaterial(EditorState& state, ObjectId material) {
    if (!ImGui::BeginDragDropSource())
        return;
    ImGui::SetDragDropPayload(kMaterial, &material, sizeof material);
    elidedText("Give " + objectName(state.document.objects.at(material)) + " to ...",
               ImGui::GetFontSize() * 20);
    ImGui::EndDragDropSource();
}

ObjectId droppedMaterial() {
    ObjectId dropped = 0;
    if (ImGui::BeginDragDropTarget()) {
        if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload(kMaterial))
            std::memcpy(&dropped, payload->Data, sizeof dropped);
        ImGui::EndDragDropTarget();
    }
    return dropped;
}

} // namespace limn
