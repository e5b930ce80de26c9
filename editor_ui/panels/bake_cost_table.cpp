// SPDX-License-Identifier: MIT
#include "editor_ui/panels/bake_cost_table.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/field.h"
#include "engine/measure/settings_sweep.h"

#include <imgui.h>

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace limn {

namespace {

constexpr const char* kUnknown = "\u2013";

/// Draws text at the right edge of the cell.
void number(const std::string& text, const char* tooltip = "") {
    ImGui::TableNextColumn();
    const float room = ImGui::GetContentRegionAvail().x;
    const float indent = room - ImGui::CalcTextSize(text.c_str()).x;
    if (indent > 0)
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + indent);
    elidedText(text, room);
    if (*tooltip)
        wrappedTooltip(tooltip);
}

void label(const char* text, const std::string& tooltip) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    elidedText(text, ImGui::GetContentRegionAvail().x);
    wrappedTooltip(tooltip.c_str());
}

std::string secondsText(double seconds) {
    return seconds > 0 ? durationText(seconds) : kUnknown;
}

std::string bytesOrUnknown(double bytes) {
    return bytes > 0 ? byteText(std::uint64_t(bytes)) : kUnknown;
}

std::string memoryTooltip(const Prediction& p) {
    std::string text = fmt::format("Memory of the bake, which relighting reads. While baking, {} "
                                   "besides the scene; as a file, {}; {} caches.",
                                   byteText(p.working), byteText(p.file), groupedNumber(p.caches));
    for (const LightingCounter& part : p.bytes)
        text += std::string(&part == &p.bytes.front() ? " " : ", ") + part.label + " " +
                byteText(std::uint64_t(part.value));
    return text;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

void stageRows(const BakeStatus& bake) {
    const StageSeconds& measured = bake.last.seconds;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const std::string& stage = measured[i].first;
        label(("    " + stage).c_str(), "A stage of the bake");
        const auto found = std::ranges::find(bake.expected.seconds, stage,
                                             [](const auto& entry) { return entry.first; });
        number(found == bake.expected.seconds.end() ? kUnknown : secondsText(found->second));
        if (contains(bake.last.keptStages, stage))
            number("kept", "Found in the store of finished stages, which took no new work");
        else
            number(durationText(measured[i].second));
    }
}

void headings() {
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch, 0.4f);
    ImGui::TableSetupColumn("predicted", ImGuiTableColumnFlags_WidthStretch, 0.3f);
    ImGui::TableSetupColumn("measured", ImGuiTableColumnFlags_WidthStretch, 0.3f);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    number("Predicted", "With the settings above, from what the last bake of this scene took");
    number("Last bake", "Measured");
}

/// Time that the stages take in all; 0 where one of them is not known.
double wholeOf(const StageSeconds& seconds) {
    const bool known = std::ranges::all_of(seconds, [](const auto& s) { return s.second > 0; });
    return known ? totalOf(seconds) : 0;
}

/// "about" where the error is that of similar settings.
void errorCells(const EditorState& state) {
    const MeasuredError* near =
        nearestError(state.goals.errors, singleton<BakeSettings>(state.document));
    label("Error", "nRMSE of the irradiance that the view shows, direct and bounced: measured by "
                   "\"Fit to a budget\" and \"Bake to an error\" in this session, in the light and "
                   "from the view of then");
    if (!near) {
        number(kUnknown, state.goals.errors.empty()
                             ? "Not known: no errors have been measured in this session"
                             : "Not known: no settings were measured that are alike these");
        ImGui::TableNextColumn();
        return;
    }
    const bool same = near->settings == singleton<BakeSettings>(state.document);
    const std::string text = fmt::format("{:.3f}", near->nrmse);
    const std::string of = settingsName(near->settings);
    number(same ? text : "about " + text,
           same ? "Measured with these settings"
                : ("That of the most similar settings that were measured: " + of).c_str());
    number(same ? text : kUnknown, same ? "Measured" : "Not measured with these settings");
}

/// Says in words whose error the table shows.
void errorNote(const EditorState& state) {
    const BakeSettings settings = singleton<BakeSettings>(state.document);
    const MeasuredError* near = nearestError(state.goals.errors, settings);
    if (near && near->settings == settings)
        return;
    ImGui::PushTextWrapPos(0);
    if (near)
        ImGui::TextDisabled("The error is that of similar settings: %s.",
                            settingsName(near->settings).c_str());
    else
        ImGui::TextDisabled("The error is not known: nothing alike was measured in this session.");
    ImGui::PopTextWrapPos();
}

} // namespace

void bakeCostTable(const EditorState& state) {
    const BakeStatus& bake = state.bake;
    if (!ImGui::BeginTable("cost", 3, ImGuiTableFlags_RowBg))
        return;
    headings();
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const bool stages = ImGui::TreeNodeEx("Bake", ImGuiTreeNodeFlags_SpanAvailWidth |
                                                      ImGuiTreeNodeFlags_NoTreePushOnOpen |
                                                      ImGuiTreeNodeFlags_FramePadding);
    wrappedTooltip("Time of a bake of every stage. A bake repeats only the stages that an edit "
                   "concerns. Open for the stages");
    number(secondsText(wholeOf(bake.expected.seconds)));
    number(bake.last.seconds.empty() ? kUnknown : durationText(totalOf(bake.last.seconds)));
    if (stages)
        stageRows(bake);
    label("Memory", memoryTooltip(state.prediction));
    number(bytesOrUnknown(bake.expected.bytes > 0 ? bake.expected.bytes
                                                  : totalOf(state.prediction.bytes)));
    number(bytesOrUnknown(bake.measured.bytes));
    label("Relighting", "One update of one bounce on the processor with all lights moved");
    number(secondsText(bake.expected.updateMs / 1000));
    number(secondsText(bake.measured.updateMs / 1000));
    errorCells(state);
    ImGui::EndTable();
    errorNote(state);
}

} // namespace limn
