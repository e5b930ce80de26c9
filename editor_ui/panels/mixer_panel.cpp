// SPDX-License-Identifier: MIT
#include "editor_ui/panels/mixer_panel.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/color_field.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/goals_panel.h"
#include "editor_ui/panels/theme.h"

#include <imgui.h>

#include <algorithm>
#include <optional>

#include <fmt/format.h>

namespace limn {

namespace {

/// What can be mixed, as ids in the order of the document.
std::vector<ObjectId> mixedObjects(const EditorState& state) {
    std::vector<ObjectId> ids;
    for (const auto& [id, object] : state.document.objects)
        if (std::holds_alternative<Light>(object) || std::holds_alternative<Sky>(object))
            ids.push_back(id);
    return ids;
}

/// Share of an object's light at the explained pixel, over all bounces; std::nullopt if no
/// explanation names the object.
std::optional<double> shareAtPixel(const EditorState& state, ObjectId id, bool sky) {
    const auto& pixel = state.explain.result;
    if (!pixel)
        return std::nullopt;
    std::optional<glm::vec3> sum;
    for (const LightRow& row : pixel->explanation.tables.byOrigin) {
        const bool light = row.kind == LightRowKind::Light && row.index < pixel->lights.size() &&
                           pixel->lights[row.index] == id;
        if (light || (sky && row.kind == LightRowKind::Sky))
            sum = sum.value_or(glm::vec3(0)) + row.value;
    }
    if (!sum)
        return std::nullopt;
    return shareOf(*sum, pixel->explanation.total);
}

void onBox(FieldEdit& edit, Light& light) {
    ImGui::Checkbox("##on", &light.enabled);
    wrappedTooltip("On or off, as the light is saved (H)");
    fieldEdited(edit, "Light on or off");
}

void soloButton(EditorState& state, ObjectId id) {
    const bool solo = state.solo.contains(id);
    if (solo)
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    if (ImGui::SmallButton(solo ? "Solo" : "solo")) {
        if (solo)
            state.solo.erase(id);
        else
            state.solo.insert(id);
    }
    if (solo)
        ImGui::PopStyleColor();
    wrappedTooltip("Shows the scene by the lights that are soloed alone, and what emits. This is "
                   "neither saved nor exported");
}

void colorSwatch(FieldEdit& edit, Light& light) {
    glm::vec3 shown = displayedColor(light.color);
    if (ImGui::ColorEdit3("##color", &shown.x, ImGuiColorEditFlags_NoInputs))
        light.color = linearOfDisplayed(shown, light.color);
    fieldEdited(edit, "Light colour");
}

void strengthSlider(FieldEdit& edit, Light& light) {
    const char* format = light.kind == LightKind::Directional ? "%.2f lux"
                         : light.kind == LightKind::Rectangle ? "%.2f nits"
                                                              : "%.2f cd";
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::SliderFloat("##strength", &light.strength, 0, 1e5f, format,
                       ImGuiSliderFlags_Logarithmic);
    wrappedTooltip("Illuminance of a sun [lux], intensity of a lamp [cd], luminance of a "
                   "rectangle [nits]. Ctrl-click to type");
    fieldEdited(edit, "Light strength");
}

void nameCell(EditorState& state, ObjectId id, const std::string& name) {
    const bool selected = std::ranges::find(state.selection, id) != state.selection.end();
    const std::string shown = elided(name, ImGui::GetContentRegionAvail().x);
    if (ImGui::Selectable((shown + "###name").c_str(), selected))
        state.selection = {id};
    if (ImGui::IsItemHovered())
        state.explain.hovered = id;
    if (shown != name)
        wrappedTooltip(name.c_str());
}

void row(EditorState& state, ObjectId id) {
    Object& object = state.document.objects.at(id);
    auto* light = std::get_if<Light>(&object);
    FieldEdit edit(state, id);
    ImGui::PushID(int(id));
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (light)
        onBox(edit, *light);
    ImGui::TableNextColumn();
    soloButton(state, id);
    ImGui::TableNextColumn();
    nameCell(state, id, objectName(object));
    ImGui::TableNextColumn();
    if (light)
        colorSwatch(edit, *light);
    ImGui::TableNextColumn();
    if (light)
        strengthSlider(edit, *light);
    ImGui::TableNextColumn();
    if (const auto share = shareAtPixel(state, id, light == nullptr))
        ImGui::Text("%5.1f %%", 100 * *share);
    else
        ImGui::TextDisabled("-");
    ImGui::PopID();
}

void headings() {
    const float font = ImGui::GetFontSize();
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("On", ImGuiTableColumnFlags_WidthFixed, 2 * font);
    ImGui::TableSetupColumn("Solo", ImGuiTableColumnFlags_WidthFixed, 3 * font);
    ImGui::TableSetupColumn("Light", ImGuiTableColumnFlags_WidthStretch, 0.4f);
    ImGui::TableSetupColumn("Colour", ImGuiTableColumnFlags_WidthFixed, 4 * font);
    ImGui::TableSetupColumn("Strength", ImGuiTableColumnFlags_WidthStretch, 0.4f);
    ImGui::TableSetupColumn("At the pixel", ImGuiTableColumnFlags_WidthFixed, 6 * font);
    ImGui::TableHeadersRow();
    wrappedTooltip("Share of the light of the pixel that was clicked, over all bounces");
}

void lightTable(EditorState& state, const std::vector<ObjectId>& ids) {
    constexpr ImGuiTableFlags kFlags =
        ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerV;
    if (!ImGui::BeginTable("lights", 6, kFlags))
        return;
    headings();
    ImGuiListClipper clipper;
    clipper.Begin(int(ids.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
            row(state, ids[std::size_t(i)]);
    ImGui::EndTable();
}

} // namespace

void mixerPanel(EditorState& state) {
    const std::vector<ObjectId> ids = mixedObjects(state);
    if (ids.empty()) {
        ImGui::TextDisabled("No lights yet. The menu Add has them");
        return;
    }
    const float width = ImGui::GetContentRegionAvail().x, font = ImGui::GetFontSize();
    const float goals = std::clamp(0.36f * width, std::min(22 * font, 0.5f * width), 34 * font);
    ImGui::BeginChild("mixed", {width - goals - font, 0});
    lightTable(state, ids);
    ImGui::EndChild();
    ImGui::SameLine(0, font);
    ImGui::BeginChild("goals", {goals, 0});
    goalsPanel(state);
    ImGui::EndChild();
}

} // namespace limn
