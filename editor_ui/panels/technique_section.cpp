// SPDX-License-Identifier: MIT
#include "editor_ui/panels/inspector_panel.h"
#include "editor_ui/panels/setting_row.h"
#include "engine/techniques/technique_table.h"

#include <imgui.h>

#include <cstdint>
#include <string>

namespace limn {

static std::string techniqueTooltip(const Technique& technique) {
    std::string text = std::string(technique.summary) + ".";
    if (*technique.source)
        text += "\n" + std::string(technique.source);
    return text;
}

static void techniqueRow(FieldEdit& edit, TechniqueChoice& choice) {
    const Technique* current = findTechnique(choice.technique);
    fieldLabel("Technique", "How bounced light is computed. Switching keeps the bake");
    if (ImGui::BeginCombo("##technique", current ? current->label : choice.technique.c_str())) {
        for (const Technique* technique : techniques()) {
            if (ImGui::Selectable(technique->label, technique == current))
                choice.technique = technique->name;
            wrappedTooltip(techniqueTooltip(*technique).c_str());
        }
        ImGui::EndCombo();
    }
    fieldEdited(edit, "Technique");
}

static double settingNumberWidget(const TechniqueSetting& s, double before) {
    if (!s.choices.empty()) {
        int chosen = int(before - s.range.lower);
        settingWidget(s.setting, chosen, {.names = {}, .labels = s.choices});
        return s.range.lower + chosen;
    }
    if (s.whole && s.range.lower == 0 && s.range.upper == 1) {
        bool on = before > 0;
        settingWidget(s.setting, on);
        return on ? 1 : 0;
    }
    if (s.whole) {
        auto count = std::uint32_t(before);
        settingWidget(s.setting, count, s.range);
        return count;
    }
    auto number = float(before);
    settingWidget(s.setting, number, s.range);
    return number == float(before) ? before : double(number);
}

static void ownSettingRow(FieldEdit& edit, TechniqueChoice& choice, const TechniqueSetting& s) {
    fieldLabel(s.setting.label, s.setting.tooltip);
    const double before = settingOf(choice, s), after = settingNumberWidget(s, before);
    if (after != before)
        choice.settings[s.setting.key] = after;
    fieldEdited(edit, s.setting.label);
}

void techniqueSection(FieldEdit& edit, TechniqueChoice& choice) {
    techniqueRow(edit, choice);
    const Technique* technique = findTechnique(choice.technique);
    if (!technique)
        return;
    ImGui::PushTextWrapPos(0);
    ImGui::TextDisabled("%s", techniqueTooltip(*technique).c_str());
    ImGui::PopTextWrapPos();
    for (const TechniqueSetting& setting : technique->settings)
        ownSettingRow(edit, choice, setting);
}

} // namespace limn
