// SPDX-License-Identifier: MIT
#include "editor_ui/document/selection.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/inspector_panel.h"

#include <imgui.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace limn {

/// The angles the user typed while the rotation is still theirs, else the rotation's own.
static glm::vec3 eulerDegrees(const EulerEdit& euler, ObjectId id, glm::quat rotation) {
    if (euler.id == id && euler.rotation == rotation)
        return euler.degrees;
    return glm::degrees(glm::eulerAngles(rotation)) + 0.f; // no "-0.0"
}

static void rotationRow(FieldEdit& edit, Node& node) {
    EulerEdit& euler = edit.state.euler;
    glm::vec3 degrees = eulerDegrees(euler, edit.id, node.transform.rotation);
    fieldLabel("Rotation (\u00b0)", "About X, then Y, then Z, in the parent's space [degrees]");
    if (ImGui::DragFloat3("##rotation", &degrees.x, 0.5f, 0, 0, "%.1f")) {
        node.transform.rotation = glm::normalize(glm::quat(glm::radians(degrees)));
        euler = {edit.id, node.transform.rotation, degrees};
    }
    fieldEdited(edit, "Rotate");
}

/// What a click found: the mesh and its material, which a button selects.
static void pickedRows(FieldEdit& edit) {
    EditorState& state = edit.state;
    const PickedSurface* picked = pickedSurface(state);
    if (!picked || picked->node != edit.id || picked->mesh >= state.assets->meshes.size())
        return;
    const Mesh& mesh = state.assets->meshes[picked->mesh];
    ImGui::Separator();
    fieldLabel("Clicked mesh", "The part of the object that was clicked in the picture");
    elidedText(mesh.name.empty() ? "Mesh " + std::to_string(picked->mesh) : mesh.name,
               ImGui::GetContentRegionAvail().x);
    fieldLabel("Its material", "Click to edit the material");
    const ObjectId material = materialOf(state, picked->mesh);
    const Object* object = findObject(state, material);
    if (!object) {
        ImGui::TextDisabled("none");
        return;
    }
    const std::string name = objectName(*object);
    if (ImGui::Button((elided(name, ImGui::GetContentRegionAvail().x - 12) + "###material").c_str(),
                      {-FLT_MIN, 0}))
        state.selection = {material};
    wrappedTooltip(name.c_str());
}

void nodeSection(FieldEdit& edit, Node& node) {
    Transform& t = node.transform;
    fieldLabel("Position (m)", "In the parent's space [m]. Ctrl-click to type a number");
    positionField("##position", t.translation);
    fieldEdited(edit, "Move");
    rotationRow(edit, node);
    fieldLabel("Scale", "Along the object's own axes; negative mirrors, 0 is not allowed");
    ImGui::DragFloat3("##scale", &t.scale.x, 0.005f, 0, 0, "%.3f");
    fieldEdited(edit, "Scale");
    ImGui::Separator();
    fieldLabel("Visible", "Hidden objects are neither drawn, baked nor lit");
    ImGui::Checkbox("##visible", &node.visible);
    fieldEdited(edit, "Visibility");
    fieldLabel("Dynamic",
               "Moves freely without a new bake: lit from the grid of caches, casts shadows, "
               "sends no bounced light of its own");
    ImGui::Checkbox("##dynamic", &node.dynamic);
    fieldEdited(edit, "Dynamic");
    std::size_t triangles = 0;
    for (std::uint32_t mesh : node.meshes)
        if (mesh < edit.state.assets->meshes.size())
            triangles += edit.state.assets->meshes[mesh].triangleCount();
    ImGui::TextDisabled("%zu %s, %s triangles", node.meshes.size(),
                        node.meshes.size() == 1 ? "mesh" : "meshes",
                        groupedNumber(triangles).c_str());
    pickedRows(edit);
}

} // namespace limn
