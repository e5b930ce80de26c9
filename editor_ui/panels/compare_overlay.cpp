// SPDX-License-Identifier: MIT
#include "editor_ui/panels/compare_overlay.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/picture_label.h"
#include "editor_ui/panels/theme.h"
#include "editor_ui/panels/viewport_corner.h"
#include "engine/techniques/technique_table.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace limn {

namespace {

constexpr float kGrabPixels = 5;

} // namespace

static float splitX(const EditorState& state) {
    return state.view.origin.x + std::round(state.compare.split * state.view.size.x);
}

bool compareHandle(EditorState& state, bool hovered) {
    CompareState& compare = state.compare;
    if (compare.mode == Compare::Off || !ImGui::IsMouseDown(0))
        compare.held = false;
    if (compare.mode == Compare::Off)
        return false;
    const bool busy = state.view.drag || state.view.navigation != Navigation::None;
    const float mouse = ImGui::GetIO().MousePos.x;
    const bool on = hovered && !busy && std::abs(mouse - splitX(state)) <= kGrabPixels;
    if (on && ImGui::IsMouseClicked(0))
        compare.held = true;
    if (compare.held)
        compare.split = std::clamp((mouse - state.view.origin.x) / state.view.size.x, 0.f, 1.f);
    if (on || compare.held)
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    return on || compare.held;
}

/// Names what is drawn on the two sides of the line, clear of the axes in the corner where there is
/// room; a side too narrow for words has no name.
static void sideLabels(const ViewState& view, float x, const std::string& left,
                       const std::string& right) {
    const float y = view.origin.y + 8, narrowest = 4 * ImGui::GetFontSize();
    const float toLeft = x - view.origin.x - 24, toRight = view.origin.x + view.size.x - x - 24;
    if (toLeft >= narrowest)
        pictureLabel({x - 12, y}, {1, 0}, left, IM_COL32_WHITE, toLeft);
    const float clear = toRight - axisWidgetWidth();
    if (toRight >= narrowest)
        pictureLabel({x + 12, y}, {0, 0}, right, IM_COL32_WHITE,
                     clear >= narrowest ? clear : toRight);
}

/// Draws text at the left edge of the picture, its lower end `above` pixels above the picture's.
/// Returns `above` for another text on top of it.
static float footLabel(const ViewState& view, const std::string& text, ImU32 ink, float above) {
    const ImVec2 position(view.origin.x + 12, view.origin.y + view.size.y - above);
    const float width = std::max(view.size.x - 24, 1.f);
    return above + 5 + pictureLabel(position, {0, 1}, text, ink, width).y;
}

static std::string referenceText(const ReferenceStatus& r) {
    if (r.samples == 0)
        return r.running ? fmt::format("Path tracing, {:.0f} %", 100 * r.fraction)
                         : std::string("No reference of this view");
    std::string text = fmt::format("Reference: {} samples a pixel, noise {:.2g} %, {:.0f} s",
                                   r.samples, 100 * r.noise, r.seconds);
    if (r.running)
        text += fmt::format("; refining, {:.0f} %", 100 * r.fraction);
    return text;
}

static std::string errorText(const Comparison& c) {
    return fmt::format(
        "nRMSE {:.3f} \u00b1 {:.3f} ({:.3f} without the worst 1 %), bias {:+.1f} \u00b1 {:.1f} %, "
        "FLIP {:.3f}",
        c.nrmse, c.nrmseNoise, c.nrmseTrimmed, 100 * c.bias, 100 * c.biasNoise, c.flip);
}

/// Name of what the right side shows. Until there is a reference, it shows the picture itself.
static const char* shownText(const CompareState& compare) {
    const bool there = compare.mode == Compare::Reference ? compare.reference.samples > 0
                                                          : compare.reference.error.has_value();
    if (!there)
        return "Waiting for the reference";
    switch (compare.mode) {
    case Compare::Off:
    case Compare::Reference:
    case Compare::Technique:
        break;
    case Compare::Difference:
        return "Difference: blue darker, orange brighter, up to 50 %";
    case Compare::Flip:
        return "FLIP, perceived difference: violet 0, green 0.5, yellow 1";
    case Compare::SquaredError:
        return "Squared relative error: violet 1e-4, green 1e-2, yellow 1";
    }
    return "Path traced";
}

static std::string techniqueLabel(const std::string& name) {
    const Technique* technique = findTechnique(name);
    return technique ? technique->label : name;
}

void compareOverlay(const EditorState& state) {
    const CompareState& compare = state.compare;
    if (compare.mode == Compare::Off)
        return;
    const ViewState& view = state.view;
    const float x = splitX(state), top = view.origin.y, bottom = view.origin.y + view.size.y;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine({x, top}, {x, bottom}, IM_COL32(0, 0, 0, 160), 3);
    list.AddLine({x, top}, {x, bottom}, compare.held ? color::kHandleLit : IM_COL32_WHITE, 1);
    constexpr float kFoot = 11; // pixels below the last line
    if (compare.mode == Compare::Technique) {
        sideLabels(view, x, techniqueLabel(singleton<TechniqueChoice>(state.document).technique),
                   techniqueLabel(compare.technique));
        footLabel(view, compare.techniqueText, color::kDim, kFoot);
        return;
    }
    sideLabels(view, x, "Limn", shownText(compare));
    const float above = footLabel(view, referenceText(compare.reference), color::kDim, kFoot);
    if (compare.reference.error)
        footLabel(view, errorText(*compare.reference.error), IM_COL32_WHITE, above);
}

} // namespace limn
