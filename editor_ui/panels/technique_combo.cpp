// SPDX-License-Identifier: MIT
#include "editor_ui/panels/technique_combo.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/panels/bar_combo.h"
#include "editor_ui/panels/field.h"
#include "engine/techniques/technique_table.h"

#include <imgui.h>

#include <utility>

namespace limn {

static void useTechnique(EditorState& state, const Technique& technique) {
    commitGesture(state);
    for (const auto& [id, object] : state.document.objects)
        if (const auto* before = std::get_if<TechniqueChoice>(&object)) {
            if (before->technique == technique.name)
                return;
            TechniqueChoice after = *before;
            after.technique = technique.name;
            applyEdit(state, {"Technique", {{id, *before, std::move(after)}}});
            return;
        }
}

static void besideItems(EditorState& state, const std::string& chosen) {
    CompareState& compare = state.compare;
    const bool beside = compare.mode == Compare::Technique;
    if (ImGui::Selectable("Nothing", !beside) && beside)
        compare.mode = Compare::Off;
    for (const Technique* technique : techniques()) {
        if (technique->name == chosen)
            continue;
        const bool shown = beside && compare.technique == technique->name;
        if (ImGui::Selectable((std::string(technique->label) + "##beside").c_str(), shown)) {
            compare.mode = Compare::Technique;
            compare.technique = technique->name;
        }
        wrappedTooltip(technique->summary);
    }
}

void techniqueCombo(EditorState& state, float width) {
    const std::string chosen = singleton<TechniqueChoice>(state.document).technique;
    const Technique* current = findTechnique(chosen);
    if (beginBarCombo("##technique", current ? current->label : chosen,
                      "What computes bounced light, and another technique to compare it with",
                      width)) {
        ImGui::TextDisabled("Technique");
        for (const Technique* technique : techniques()) {
            if (ImGui::Selectable(technique->label, technique == current))
                useTechnique(state, *technique);
            wrappedTooltip(technique->summary);
        }
        ImGui::Separator();
        ImGui::TextDisabled("Beside it, right of the line");
        besideItems(state, chosen);
        ImGui::EndCombo();
    }
    ImGui::SameLine();
}

} // namespace limn
