// SPDX-License-Identifier: MIT
#include "editor_ui/panels/compare_overlay.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/theme.h"
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

/// Text on a dark ground; `align` 0: begins at `at`, 1: ends there.
static void label(ImVec2 at, float align, const std::string& text, ImU32 ink) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    at.x -= align * size.x;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({at.x - 5, at.y - 2}, {at.x + size.x + 5, at.y + size.y + 2}, color::kGround,
                       3);
    list.AddText(at, ink, text.c_str());
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
        c.nrmse, c.nrmseNoise, c.nrmseMost, 100 * c.bias, 100 * c.biasNoise, c.flip);
}

static const char* shownText(Compare mode) {
    switch (mode) {
    case Compare::Off:
    case Compare::Reference:
    case Compare::Technique:
        break;
    case Compare::Difference:
        return "Difference: blue darker, orange brighter, up to 50 %";
    case Compare::Flip:
        return "FLIP, perceived difference: violet 0, green 0.5, yellow 1";
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
    const float line = ImGui::GetTextLineHeight() + 5;
    const float left = view.origin.x + 12;
    if (compare.mode == Compare::Technique) {
        label({x - 12, top + 8}, 1,
              techniqueLabel(singleton<TechniqueChoice>(state.document).technique), IM_COL32_WHITE);
        label({x + 12, top + 8}, 0, techniqueLabel(compare.technique), IM_COL32_WHITE);
        label({left, bottom - line - 6}, 0, compare.techniqueText, color::kDim);
        return;
    }
    label({x - 12, top + 8}, 1, "Limn", IM_COL32_WHITE);
    label({x + 12, top + 8}, 0, shownText(compare.mode), IM_COL32_WHITE);
    if (compare.reference.error)
        label({left, bottom - 2 * line - 6}, 0, errorText(*compare.reference.error),
              IM_COL32_WHITE);
    label({left, bottom - line - 6}, 0, referenceText(compare.reference), color::kDim);
}

} // namespace limn
