// SPDX-License-Identifier: MIT
#include "editor_ui/panels/viewport_corner.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/picture_label.h"
#include "editor_ui/panels/theme.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace limn {

namespace {

constexpr float kArm = 28, kEnd = 9; ///< at 96 dpi [px]

/// An end of an axis on the screen.
struct AxisEnd {
    int axis;      ///< 0: X
    bool positive; ///< the end that has a letter
    float depth;   ///< towards the viewer, [-1, 1]
    ImVec2 position;
};

/// Ends of all axes, those further away first.
std::array<AxisEnd, 6> endsOf(const Camera& camera, ImVec2 centre) {
    const glm::mat3 toView(viewMatrix(camera));
    std::array<AxisEnd, 6> ends;
    for (int i = 0; i < 6; ++i) {
        const int axis = i / 2;
        const glm::vec3 d = toView[axis] * (i % 2 == 0 ? 1.f : -1.f) * (kArm * uiScale());
        ends[std::size_t(i)] = {axis, i % 2 == 0, d.z, {centre.x + d.x, centre.y - d.y}};
    }
    std::ranges::sort(ends, {}, &AxisEnd::depth);
    return ends;
}

const char* actionOf(const AxisEnd& end) {
    constexpr const char* kActions[3][2] = {
        {"view.left", "view.right"}, {"view.bottom", "view.top"}, {"view.back", "view.front"}};
    return kActions[end.axis][end.positive ? 1 : 0];
}

bool isOver(const AxisEnd& end) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    return glm::distance(glm::vec2(mouse.x, mouse.y), glm::vec2(end.position.x, end.position.y)) <=
           kEnd * uiScale();
}

void drawEnd(const AxisEnd& end, ImVec2 centre, bool over) {
    constexpr ImU32 kColors[] = {color::kAxisX, color::kAxisY, color::kAxisZ};
    constexpr const char* kNames[] = {"X", "Y", "Z"};
    const ImU32 ink = over ? color::kHandleLit : kColors[end.axis];
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float radius = kEnd * uiScale();
    if (!end.positive) {
        list.AddCircleFilled(end.position, radius * 0.6f, color::kGround);
        list.AddCircle(end.position, radius * 0.6f, ink, 0, 1.5f);
        return;
    }
    list.AddLine(centre, end.position, ink, 2);
    list.AddCircleFilled(end.position, radius, ink);
    const ImVec2 size = ImGui::CalcTextSize(kNames[end.axis]);
    list.AddText({end.position.x - size.x / 2, end.position.y - size.y / 2},
                 IM_COL32(15, 16, 18, 255), kNames[end.axis]);
}

/// Label of the work that still refines the picture; empty if there is none.
std::string refining(const EditorState& state) {
    if (state.bake.preview && state.bake.running)
        return ", preview";
    if (state.relight.running && !state.relight.converged)
        return ", refining";
    if (float(state.frame.width) + 1 < state.view.size.x)
        return ", coarse while moving";
    if (state.frame.gathered > 0 && state.frame.gathered < 1)
        return fmt::format(", gathering {:.0f} %", 100 * state.frame.gathered);
    return "";
}

} // namespace

float axisWidgetWidth() {
    return 2 * (kArm + kEnd + 8) * uiScale();
}

bool axisWidget(EditorState& state, bool hovered) {
    const ViewState& view = state.view;
    const float reach = axisWidgetWidth() / 2;
    const bool room = view.size.x >= 6 * reach && view.size.y >= 6 * reach;
    if (!room || state.notice) // a notice may reach into the corner
        return false;
    const ImVec2 centre(view.origin.x + view.size.x - reach, view.origin.y + reach);
    const bool free = hovered && !view.drag && view.navigation == Navigation::None;
    const auto ends = endsOf(view.camera, centre);
    const AxisEnd* over = nullptr;
    for (const AxisEnd& end : ends) // the nearest one is last
        if (free && isOver(end))
            over = &end;
    for (const AxisEnd& end : ends)
        drawEnd(end, centre, over == &end);
    if (!over)
        return false;
    const Action& action = actionById(actionOf(*over));
    ImGui::SetTooltip("%s", action.label);
    if (ImGui::IsMouseClicked(0))
        runAction(state, action);
    return true;
}

void pictureReadout(const EditorState& state) {
    const FrameStatus& f = state.frame;
    const ViewState& view = state.view;
    if (f.pictures == 0 || state.compare.mode != Compare::Off)
        return;
    const float margin = 8 * uiScale();
    const std::string text = elided(
        fmt::format("{} \u00d7 {}, {:.1f} ms{}", f.width, f.height, f.viewportMs, refining(state)),
        view.size.x - 4 * margin);
    const ImVec2 corner(view.origin.x + view.size.x - 2 * margin,
                        view.origin.y + view.size.y - 1.5f * margin);
    pictureLabel(corner, {1, 1}, text, IM_COL32(210, 212, 216, 255), 0,
                 {.margin = {margin, margin / 2}});
}

} // namespace limn
