// SPDX-License-Identifier: MIT
#include "editor_ui/panels/goals_panel.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/picture_label.h"
#include "editor_ui/panels/theme.h"
#include "editor_ui/view/gizmo_math.h"
#include "engine/math/luminance.h"

#include <imgui.h>

#include <algorithm>
#include <optional>

#include <fmt/format.h>

namespace limn {

namespace {

constexpr float kLeast = 1e-4f, kGreatest = 1e6f; // that can be asked for

/// A goal for the explained pixel, which asks for the light that it has.
std::optional<GoalsState::Goal> goalOfPick(const ExplainState& explain) {
    if (!explain.pick || !explain.result || explain.running)
        return std::nullopt;
    GoalsState::Goal goal{.pick = *explain.pick};
    goal.pick.question.light = explain.result->light;
    goal.now = luminance(glm::dvec3(explain.result->explanation.total));
    goal.wanted = std::clamp(float(goal.now), kLeast, kGreatest);
    return goal;
}

void addButton(ExplainState& explain) {
    const std::optional<GoalsState::Goal> goal = goalOfPick(explain);
    ImGui::BeginDisabled(!goal);
    if (ImGui::Button("Add goal") && goal)
        explain.goals.goals.push_back(*goal);
    ImGui::EndDisabled();
    wrappedTooltip("The surface that was clicked in the picture is to have some light. Its number "
                   "marks it there");
}

void choices(GoalsState& goals) {
    ImGui::SameLine();
    if (ImGui::RadioButton("All lights", !goals.selectedOnly))
        goals.selectedOnly = false;
    wrappedTooltip("All lights that are on may change their strengths");
    ImGui::SameLine();
    if (ImGui::RadioButton("Selected", goals.selectedOnly))
        goals.selectedOnly = true;
    wrappedTooltip("Only the selected lights may change their strengths");
}

void solveButton(GoalsState& goals) {
    const bool working = goals.running || goals.start;
    ImGui::BeginDisabled(goals.goals.empty() || working);
    if (ImGui::Button(working ? "Working###solve" : "Solve###solve"))
        goals.start = true;
    ImGui::EndDisabled();
    wrappedTooltip("Finds the strengths with which the places come nearest to what they are to "
                   "have, all bounces included. One step to undo");
}

/// Returns false if the goal is to go.
bool goalRow(GoalsState::Goal& goal, int number) {
    ImGui::PushID(number);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::Text("%d", number);
    ImGui::TableNextColumn();
    ImGui::Text("%.4g", goal.now);
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::DragFloat("##wanted", &goal.wanted, std::max(goal.wanted * 0.01f, 1e-5f), kLeast,
                     kGreatest, "%.4g", ImGuiSliderFlags_AlwaysClamp);
    wrappedTooltip(fmt::format("Luminance of the {} [{}]. Ctrl-click to type",
                               goal.pick.question.light == PixelLight::Irradiance
                                   ? "light that arrives there"
                                   : "light that reaches the eye",
                               unitOf(goal.pick.question.light))
                       .c_str());
    ImGui::TableNextColumn();
    if (goal.solved)
        ImGui::Text("%.4g", *goal.solved);
    else
        ImGui::TextDisabled("-");
    ImGui::TableNextColumn();
    const bool stays = !ImGui::SmallButton("x");
    wrappedTooltip("Removes the goal");
    ImGui::PopID();
    return stays;
}

void goalTable(GoalsState& goals) {
    constexpr ImGuiTableFlags kFlags =
        ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerV;
    if (!ImGui::BeginTable("goals", 5, kFlags))
        return;
    const float font = ImGui::GetFontSize();
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("No.", ImGuiTableColumnFlags_WidthFixed, 2 * font);
    ImGui::TableSetupColumn("Was", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("Goal", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("Solved", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("##remove", ImGuiTableColumnFlags_WidthFixed, 1.5f * font);
    ImGui::TableHeadersRow();
    wrappedTooltip("Luminance of the light that reaches the eye [W m^-2 sr^-1] or arrives at the "
                   "surface [W m^-2], whichever the tab Explain shows when a goal is added");
    int number = 0;
    std::erase_if(goals.goals, [&](GoalsState::Goal& goal) { return !goalRow(goal, ++number); });
    ImGui::EndTable();
}

} // namespace

void goalsPanel(EditorState& state) {
    GoalsState& goals = state.explain.goals;
    addButton(state.explain);
    ImGui::SameLine();
    solveButton(goals);
    choices(goals);
    const float width = ImGui::GetContentRegionAvail().x;
    if (goals.running) {
        ImGui::ProgressBar(goals.fraction, {width, 0}, goals.stage.c_str());
    } else if (!goals.error.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, color::warning());
        elidedText(goals.error, width);
        ImGui::PopStyleColor();
    }
    if (goals.goals.empty())
        elidedText("Click a surface in the picture, then add a goal for its light", width);
    else
        goalTable(goals);
}

void goalMarks(const EditorState& state) {
    int number = 0;
    for (const GoalsState::Goal& goal : state.explain.goals.goals) {
        ++number;
        if (const auto pixel = toPixel(state.view.picture(), goal.pick.point))
            pictureLabel({pixel->x, pixel->y}, {0.5f, 0.5f}, fmt::format("{}", number),
                         color::kHandleLit, 0, {.margin = {5, 2}, .rounding = 4});
    }
}

} // namespace limn
