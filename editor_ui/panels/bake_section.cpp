// SPDX-License-Identifier: MIT
#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/bake_cost_table.h"
#include "editor_ui/panels/card.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/inspector_panel.h"
#include "editor_ui/panels/setting_row.h"
#include "editor_ui/panels/theme.h"
#include "engine/scene/bake_settings_fields.h"

#include <imgui.h>

#include <algorithm>

namespace limn {

/// Which of the two settings for the lightmap's size holds.
static void lightmapSizeRow(FieldEdit& edit, BakeSettings& s) {
    int byDensity = s.texelsPerMetre > 0;
    fieldLabel("Lightmap size by",
               "Total: about this many texels over the scene. Density: the same everywhere");
    if (ImGui::Combo("##by", &byDensity, "Total texels\0Density\0")) {
        s.texelsPerMetre = byDensity ? 4.f : 0.f;
        s.lightmapCaches = byDensity ? 0 : BakeSettings{}.lightmapCaches;
    }
    fieldEdited(edit, "Lightmap size");
}

static void minTexelsLine(const Prediction& p) {
    if (p.minTexels == 0)
        return;
    ImGui::PushTextWrapPos(0);
    ImGui::TextDisabled("The objects need at least about %s texels: one for each direction "
                        "that an object faces.",
                        groupedNumber(p.minTexels).c_str());
    ImGui::PopTextWrapPos();
}

static void actionButton(EditorState& state, const char* id) {
    const Action& action = actionById(id);
    ImGui::BeginDisabled(!action.enabled(state));
    if (ImGui::Button(action.label, {-FLT_MIN, 0}))
        runAction(state, action);
    ImGui::EndDisabled();
}

static void bakeStateLine(EditorState& state) {
    const BakeStatus& bake = state.bake;
    ImGui::Spacing();
    ImGui::PushTextWrapPos(0);
    const bool refining = bake.preview && bake.running;
    if (refining)
        ImGui::TextDisabled("The picture shows a preview of few rays; the full bake is running.");
    else
        switch (bake.freshness) {
        case BakeFreshness::NotUsed:
            ImGui::TextDisabled("The technique of bounced light needs no bake.");
            break;
        case BakeFreshness::None:
            ImGui::TextColored(ImColor(color::warning()),
                               "Bake needed: nothing is baked yet, so there is no bounced light.");
            break;
        case BakeFreshness::Checking:
            ImGui::TextDisabled("Comparing with the last bake...");
            break;
        case BakeFreshness::UpToDate:
            ImGui::TextColored(ImColor(color::good()), "The bake is up to date.");
            break;
        case BakeFreshness::Needed:
            ImGui::TextColored(ImColor(color::warning()), "Bake needed: %s.",
                               bakeReason(bake).c_str());
            break;
        }
    for (const std::string& note : bake.last.notes)
        ImGui::TextDisabled("%s", note.c_str());
    if (!bake.goal.empty())
        ImGui::TextDisabled("%s", bake.goal.c_str());
    if (!bake.error.empty())
        ImGui::TextColored(ImColor(color::error()), "Last bake: %s", bake.error.c_str());
    ImGui::PopTextWrapPos();
    actionButton(state, bake.running ? "bake.cancel" : "bake.start");
}

static void errorRow(EditorState& state) {
    fieldLabel("Error (nRMSE)",
               "Instead of a quality, an error: bakes begin with the counts of Draft and get finer "
               "until the irradiance that this view shows differs from path tracing by at most "
               "this share of its root mean square");
    ImGui::SliderFloat("##error", &state.goals.maxError, 0.02f, 1, "%.2f",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    if (!state.bake.running)
        actionButton(state, "bake.error");
}

static void budgetRows(EditorState& state) {
    fieldLabel("Update (ms)",
               "Maximum time of one update of one bounce on the processor, all lights moved [ms]");
    ImGui::DragFloat("##budgetMs", &state.goals.budgetMs, 0.05f, 0.1f, 1000, "%.2f",
                     ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    fieldLabel("Memory (MiB)",
               "Maximum memory of the bake and of what updates read and write beside it [MiB]");
    ImGui::DragFloat("##budgetMiB", &state.goals.budgetMiB, 0.2f, 1, 65536, "%.1f",
                     ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    actionButton(state, "bake.budget");
    wrappedTooltip("Measures settings for up to five minutes and takes those whose light, as this "
                   "view shows it, has the least error within both limits. One edit, which can "
                   "be undone");
}

static void presetRow(FieldEdit& edit, BakeSettings& s) {
    constexpr const char* kLabels[] = {"Draft", "Medium", "High"};
    static_assert(std::size(kLabels) == kBakePresets.size());
    const auto* preset =
        std::ranges::find_if(kBakePresets, [&](const BakePreset& p) { return p.describes(s); });
    const auto current = std::size_t(preset - kBakePresets.begin());
    fieldLabel("Quality", "Surfels, links, rays and lightmap texels that go together. Each step "
                          "takes three to five times as long to bake as the one before; Medium is "
                          "the default. Custom: counts of your own");
    if (ImGui::BeginCombo("##preset", preset == kBakePresets.end() ? "Custom" : kLabels[current])) {
        for (std::size_t i = 0; i < kBakePresets.size(); ++i)
            if (ImGui::Selectable(kLabels[i], i == current))
                kBakePresets[i].applyTo(s);
        ImGui::EndCombo();
    }
    fieldEdited(edit, "Quality");
}

static void settingRows(FieldEdit& edit, BakeSettings& s, int group) {
    visitBakeSettings(s, [&](const Setting& setting, auto& value, const auto&... limits) {
        if (setting.group == group && setting.applies)
            settingRow(edit, setting, value, limits...);
    });
}

static void allSettingRows(FieldEdit& edit, BakeSettings& s) {
    presetRow(edit, s);
    for (int group = 0; group < kResearchGroup; ++group) {
        if (group == kLightmapGroup)
            lightmapSizeRow(edit, s);
        settingRows(edit, s, group);
    }
    const bool advanced = ImGui::TreeNodeEx("Advanced", ImGuiTreeNodeFlags_SpanAvailWidth);
    wrappedTooltip("The method's variants, for research: the defaults are best in most scenes");
    if (advanced) {
        settingRows(edit, s, kResearchGroup);
        ImGui::TreePop();
    }
    minTexelsLine(edit.state.prediction);
}

void bakeSection(FieldEdit& edit, BakeSettings& s) {
    bakeStateLine(edit.state);
    if (card(edit.state, "Settings"))
        allSettingRows(edit, s);
    if (card(edit.state, "Bake to an error"))
        errorRow(edit.state);
    if (card(edit.state, "Fit to a budget"))
        budgetRows(edit.state);
    if (card(edit.state, "Predicted and measured"))
        bakeCostTable(edit.state);
}

} // namespace limn
