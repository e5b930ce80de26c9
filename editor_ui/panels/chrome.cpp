// SPDX-License-Identifier: MIT
#include "editor_ui/panels/chrome.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/bar_combo.h"
#include "editor_ui/panels/exposure_field.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/icon.h"
#include "editor_ui/panels/menu.h"
#include "editor_ui/panels/overlay_panel.h"
#include "editor_ui/panels/technique_combo.h"
#include "editor_ui/panels/theme.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace limn {

static std::string documentTitle(const EditorState& state) {
    std::string name = std::filesystem::path(documentPath(state)).filename().string();
    if (name.empty())
        name = "Untitled";
    return hasUnsavedChanges(state) ? name + " (not saved)" : name;
}

static void workspaceButtons(EditorState& state) {
    struct Button {
        const char *label, *action, *tooltip;
    };
    static constexpr Button kButtons[] = {
        {"Light", "workspace.light", "A large picture, for placing and tuning lights"},
        {"Bake", "workspace.bake", "What a bake takes, beside the picture"},
        {"Inspect", "workspace.inspect", "Where the light of a pixel comes from"},
        {"Compare", "workspace.compare", "The path-traced reference beside the picture"}};
    ImGui::Dummy({ImGui::GetFontSize(), 0});
    ImGui::PushID("workspace"); // the bar has a menu "Bake", too
    for (const Button& button : kButtons) {
        const Action& action = actionById(button.action);
        const bool current = action.checked(state);
        ImGui::PushStyleColor(ImGuiCol_Button, current
                                                   ? ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive)
                                                   : ImVec4(0, 0, 0, 0));
        if (ImGui::SmallButton(button.label))
            runAction(state, action);
        ImGui::PopStyleColor();
        wrappedTooltip(fmt::format("{}. A workspace remembers its panels, overlay and comparison",
                                   button.tooltip)
                           .c_str());
    }
    ImGui::PopID();
}

void menuBar(EditorState& state) {
    if (!ImGui::BeginMainMenuBar())
        return;
    menus(state);
    workspaceButtons(state);
    const std::string title = documentTitle(state);
    const float room = ImGui::GetContentRegionAvail().x;
    const float width = std::min(ImGui::CalcTextSize(title.c_str()).x, room - 20);
    if (width > 20) {
        ImGui::SameLine(ImGui::GetCursorPosX() + room - width - 4);
        ImGui::PushStyleColor(ImGuiCol_Text, color::dim());
        elidedText(title, width + 1);
        ImGui::PopStyleColor();
    }
    ImGui::EndMainMenuBar();
}

static void toolButton(EditorState& state, const char* id, const char* label, ImVec2 size = {}) {
    const Action& action = actionById(id);
    const bool active = action.checked && action.checked(state);
    ImGui::BeginDisabled(!action.enabled(state));
    if (active)
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    if (ImGui::Button(label, size))
        runAction(state, action);
    if (active)
        ImGui::PopStyleColor();
    ImGui::EndDisabled();
    const std::string key = shortcutText(shortcutOf(state, action));
    wrappedTooltip((action.label + (key.empty() ? key : " (" + key + ")")).c_str());
    ImGui::SameLine();
}

constexpr float kToolGap = 2; // between the buttons of the tools [px]

/// Widths of the fields above the picture [em]. A narrow window shrinks the lists by one factor,
/// for their names may end in an ellipsis; the exposure is a number and keeps its width for longer.
struct BarWidths {
    float technique = 12, view = 7, overlay = 9, exposure = 8;

    /// `left`: width that they share [px].
    static BarWidths within(float left) {
        constexpr BarWidths kFull;
        constexpr float kLists = kFull.technique + kFull.view + kFull.overlay;
        const float font = ImGui::GetFontSize();
        const float exposure =
            std::clamp(0.35f * left, 0.3f * kFull.exposure * font, kFull.exposure * font);
        const float em = font * std::clamp((left - exposure) / (kLists * font), 0.3f, 1.f);
        return {kFull.technique * em, kFull.view * em, kFull.overlay * em, exposure};
    }
};

/// A square button for each tool of the gizmo.
static void toolIcons(EditorState& state) {
    static constexpr std::pair<const char*, Icon> kTools[] = {{"tool.select", Icon::Pointer},
                                                              {"tool.move", Icon::Move},
                                                              {"tool.rotate", Icon::Rotate},
                                                              {"tool.scale", Icon::Scale}};
    const float side = ImGui::GetFrameHeight();
    for (const auto& [id, icon] : kTools) {
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        toolButton(state, id, (std::string("##") + id).c_str(), {side, side});
        drawIcon(*ImGui::GetWindowDrawList(), icon, {corner.x + side / 2, corner.y + side / 2},
                 0.6f * side, ImGui::GetColorU32(ImGuiCol_Text));
        ImGui::SameLine(0, kToolGap);
    }
    ImGui::SameLine();
}

/// A list of all values of an enumeration, by name.
template <class Value, std::size_t n>
static void valueCombo(const char* id, Value& value, const char* const (&names)[n],
                       const char* tooltip, float width) {
    if (beginBarCombo(id, names[std::size_t(value)], tooltip, width)) {
        for (std::size_t i = 0; i < n; ++i)
            if (ImGui::Selectable(names[i], i == std::size_t(value)))
                value = Value(i);
        ImGui::EndCombo();
    }
    ImGui::SameLine();
}

static void viewCombo(EditorState& state, float width) {
    static constexpr const char* kViews[] = {"Lit",        "Direct only", "Indirect only",
                                             "Irradiance", "Albedo",      "Normals"};
    static_assert(std::size(kViews) == kViewNames.size());
    valueCombo("##view", state.view.view, kViews, "What the picture shows", width);
}

void viewBar(EditorState& state) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const bool saves = needsReference(state.compare.mode);
    const float buttons = ImGui::CalcTextSize(saves ? "RefEXR\u2026" : "Ref").x +
                          (saves ? 4 : 2) * style.FramePadding.x +
                          (saves ? 6 : 5) * style.ItemSpacing.x + 4 * ImGui::GetFrameHeight() +
                          3 * kToolGap;
    const BarWidths widths = BarWidths::within(ImGui::GetContentRegionAvail().x - buttons);
    toolIcons(state);
    techniqueCombo(state, widths.technique);
    toolButton(state, "compare.reference", "Ref");
    if (saves)
        toolButton(state, "compare.save", "EXR\u2026");
    viewCombo(state, widths.view);
    overlayCombo(state, widths.overlay);
    ImGui::SameLine();
    exposureField(state.view, widths.exposure);
}

static void bakeProgress(EditorState& state) {
    const BakeStatus& bake = state.bake;
    ImGui::AlignTextToFramePadding();
    ImGui::Text("%s: %s", bake.preview ? "Refining" : "Baking",
                bake.stage.empty() ? "starting" : bake.stage.c_str());
    ImGui::SameLine(ImGui::GetFontSize() * 11);
    const bool toError = !bake.step.empty();
    const std::string text = toError ? bake.step
                                     : fmt::format("{:.0f} % of the stage, {:.0f} % in all",
                                                   100 * bake.stageFraction, 100 * bake.fraction);
    const float width = ImGui::GetFontSize() * (toError ? 24.f : 18.f);
    ImGui::ProgressBar(toError ? bake.stageFraction : bake.fraction, {width, 0}, text.c_str());
    ImGui::SameLine();
    if (toError && bake.fitting)
        ImGui::Text("within %.1f ms, %.0f MiB", double(state.goals.budgetMs),
                    double(state.goals.budgetMiB));
    else if (toError)
        ImGui::Text("until %.2f", double(state.goals.maxError));
    else if (bake.secondsLeft >= 1)
        ImGui::Text("about %s left", durationText(bake.secondsLeft).c_str());
    else
        ImGui::TextUnformatted(bake.secondsLeft < 0 ? "estimating..." : "nearly done");
    ImGui::SameLine();
    const Action& cancel = actionById("bake.cancel");
    if (ImGui::Button("Cancel"))
        runAction(state, cancel);
    wrappedTooltip("Stops the bake; the last good one stays in place");
}

static void bakeWords(EditorState& state) {
    if (state.assets->meshes.empty()) {
        ImGui::TextDisabled("Nothing to bake");
        return;
    }
    switch (state.bake.freshness) {
    case BakeFreshness::NotUsed:
        return;
    case BakeFreshness::None:
        ImGui::TextColored(ImColor(color::warning()), "Bake needed: nothing baked yet");
        break;
    case BakeFreshness::Checking:
        ImGui::TextDisabled("Checking the bake");
        break;
    case BakeFreshness::UpToDate:
        ImGui::TextDisabled("Bake up to date");
        break;
    case BakeFreshness::Needed:
        ImGui::PushStyleColor(ImGuiCol_Text, color::warning());
        elidedText("Bake needed: " + bakeReason(state.bake), ImGui::GetFontSize() * 24);
        ImGui::PopStyleColor();
        break;
    }
    if (state.bake.freshness != BakeFreshness::None &&
        state.bake.freshness != BakeFreshness::Needed)
        return;
    const Action& start = actionById("bake.start");
    if (!start.enabled(state))
        return;
    ImGui::SameLine();
    if (ImGui::SmallButton("Bake now"))
        runAction(state, start);
}

static void idleWords(EditorState& state) {
    ImGui::AlignTextToFramePadding();
    bakeWords(state);
    if (state.bake.freshness == BakeFreshness::None)
        return;
    if (state.bake.freshness != BakeFreshness::NotUsed)
        ImGui::SameLine(0, 24);
    const LightingStatus& r = state.relight;
    if (r.last.diverges)
        ImGui::TextUnformatted("Light grew with every bounce and was stopped: bake again");
    else if (r.converged && r.bounces == 0)
        ImGui::TextDisabled("Light up to date");
    else if (r.converged)
        ImGui::TextDisabled("Light converged after %u bounce%s", r.bounces,
                            r.bounces == 1 ? "" : "s");
    else if (r.running)
        ImGui::Text("Light bouncing: %u", r.bounces);
    if (r.last.lacks) {
        ImGui::SameLine(0, 24);
        elidedText(std::string("Incomplete: ") + r.last.lacks, ImGui::GetContentRegionAvail().x);
    }
}

void statusBar(EditorState& state) {
    if (!state.loading.empty()) {
        ImGui::AlignTextToFramePadding();
        elidedText("Opening " + state.loading, ImGui::GetContentRegionAvail().x);
    } else if (state.bake.running) {
        bakeProgress(state);
    } else {
        idleWords(state);
    }
}

} // namespace limn
