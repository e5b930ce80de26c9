// SPDX-License-Identifier: MIT
#include "editor_ui/document/selection.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/panels/card.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/inspector_panel.h"
#include "editor_ui/panels/material_choice.h"

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
    fieldLabel<Node>(edit, "Rotation (\u00b0)",
                     "About X, then Y, then Z, in the parent's space [degrees]",
                     [](const Node& n) { return n.transform.rotation; });
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
    ImGui::Spacing();
    fieldLabel("Clicked mesh", "The part of the object that was clicked in the picture");
    elidedText(mesh.name.empty() ? "Mesh " + std::to_string(picked->mesh) : mesh.name,
               ImGui::GetContentRegionAvail().x);
    materialChoice(state, {edit.id}, picked->mesh);
}

/// The node's material and that of the others that are edited with it.
static void materialRows(FieldEdit& edit) {
    std::vector<ObjectId> nodes = edit.others;
    nodes.push_back(edit.id);
    materialChoice(edit.state, nodes);
    // Assigning is an edit of its own; what follows compares with the node as it is now.
    edit.seen = edit.state.document.objects.at(edit.id);
}

static void transformRows(FieldEdit& edit, Node& node) {
    Transform& t = node.transform;
    fieldLabel("Position (m)", "In the parent's space [m]. Ctrl-click to type a number");
    positionField("##position", t.translation);
    fieldEdited(edit, "Move");
    rotationRow(edit, node);
    fieldLabel<Node>(edit, "Scale",
                     "Along the object's own axes; negative mirrors, 0 is not allowed",
                     [](const Node& n) { return n.transform.scale; });
    ImGui::DragFloat3("##scale", &t.scale.x, 0.005f, 0, 0, "%.3f");
    fieldEdited(edit, "Scale");
}

static void visibilityRows(FieldEdit& edit, Node& node) {
    fieldLabel<Node>(edit, "Visible", "Hidden objects are neither drawn, baked nor lit",
                     &Node::visible);
    ImGui::Checkbox("##visible", &node.visible);
    fieldEdited(edit, "Visibility");
    fieldLabel<Node>(edit, "Dynamic",
                     "Moves freely without a new bake: lit from the grid of caches, casts shadows, "
                     "sends no bounced light of its own",
                     &Node::dynamic);
    ImGui::Checkbox("##dynamic", &node.dynamic);
    fieldEdited(edit, "Dynamic");
}

static void lightmapRow(FieldEdit& edit, Node& node) {
    fieldLabel<Node>(edit, "Texel density",
                     "Lightmap texels per metre of this object, relative to what the bake would "
                     "give it [times]; groups multiply that of what is in them. The bake's number "
                     "of texels stays the same: other objects get fewer. Ctrl-click to type a "
                     "number",
                     &Node::texelDensity);
    ImGui::SliderFloat("##texelDensity", &node.texelDensity, kMinTexelDensity, kMaxTexelDensity,
                       "%.2f \u00d7", ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    fieldEdited(edit, "Texel density");
}

static void meshLine(const EditorState& state, const Node& node) {
    std::size_t triangles = 0;
    for (std::uint32_t mesh : node.meshes)
        if (mesh < state.assets->meshes.size())
            triangles += state.assets->meshes[mesh].triangleCount();
    ImGui::TextDisabled("%zu %s, %s triangles", node.meshes.size(),
                        node.meshes.size() == 1 ? "mesh" : "meshes",
                        groupedNumber(triangles).c_str());
}

void nodeSection(FieldEdit& edit, Node& node) {
    if (card(edit.state, "Transform"))
        transformRows(edit, node);
    if (card(edit.state, "Visibility"))
        visibilityRows(edit, node);
    if (card(edit.state, "Lightmap"))
        lightmapRow(edit, node);
    if (card(edit.state, "Mesh and material")) {
        meshLine(edit.state, node);
        materialRows(edit);
        pickedRows(edit);
    }
}

} // namespace limn
