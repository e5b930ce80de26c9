// SPDX-License-Identifier: MIT
#include "editor_ui/panels/inspector_panel.h"

#include "editor_ui/document/object_rules.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/panels/field.h"

#include <imgui.h>
#include <imgui_stdlib.h>

namespace limn {

static void nameRow(FieldEdit& edit, Object& object) {
    std::string* name = nameOf(object);
    if (!name)
        return;
    fieldLabel("Name", "How the object is listed; need not be unique");
    ImGui::InputText("##name", name);
    fieldEdited(edit, "Name");
    if (name->size() > 24)
        wrappedTooltip(name->c_str());
}

static void section(FieldEdit& edit, Object& object) {
    if (auto* node = std::get_if<Node>(&object))
        nodeSection(edit, *node);
    else if (auto* light = std::get_if<Light>(&object))
        lightSection(edit, *light);
    else if (auto* material = std::get_if<Material>(&object))
        materialSection(edit, *material);
    else if (auto* sky = std::get_if<Sky>(&object))
        skySection(edit, *sky);
    else if (auto* camera = std::get_if<Camera>(&object))
        cameraSection(edit, *camera);
    else if (auto* settings = std::get_if<BakeSettings>(&object))
        bakeSection(edit, *settings);
    else if (auto* choice = std::get_if<TechniqueChoice>(&object))
        techniqueSection(edit, *choice);
    else if (auto* relight = std::get_if<RelightSettings>(&object))
        relightSection(edit, *relight);
}

/// The other selected objects of the same type; none for what a document has one of.
static std::vector<ObjectId> othersLike(const EditorState& state, const Object& object) {
    std::vector<ObjectId> others;
    for (ObjectId id : state.selection) {
        const auto it = state.document.objects.find(id);
        if (id != activeId(state) && it != state.document.objects.end() &&
            it->second.index() == object.index())
            others.push_back(id);
    }
    return others;
}

void inspectorPanel(EditorState& state) {
    const ObjectId id = activeId(state);
    Object* object = findObject(state, id);
    if (!object) {
        ImGui::TextDisabled("Nothing selected");
        ImGui::Spacing();
        ImGui::PushTextWrapPos(0);
        ImGui::TextDisabled("Click something in the picture or in the list on the left.");
        ImGui::PopTextWrapPos();
        return;
    }
    ImGui::PushID(int(id));
    ImGui::TextUnformatted(kindName(*object));
    FieldEdit edit(state, id);
    if (state.selection.size() > 1) {
        ImGui::SameLine();
        ImGui::TextDisabled("(last of %zu selected)", state.selection.size());
    }
    ImGui::Separator();
    nameRow(edit, *object); // a name is one object's own
    edit.others = othersLike(state, *object);
    if (!edit.others.empty()) {
        ImGui::TextDisabled("Edits go to %zu objects", edit.others.size() + 1);
        wrappedTooltip("The values are those of the object selected last. A value that is changed "
                       "is given to every selected object of its type; positions move by as much");
    }
    section(edit, *object);
    ImGui::PopID();
}

} // namespace limn
