// SPDX-License-Identifier: MIT
#include "editor_ui/panels/chrome.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/bar_combo.h"
#include "editor_ui/panels/exposure_field.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/overlay_panel.h"
#include "editor_ui/panels/snap_steps.h"
#include "editor_ui/panels/technique_combo.h"
#include "editor_ui/panels/theme.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace limn {

static void actionItem(EditorState& state, const Action& action) {
    const std::string label = actionLabel(state, action);
    const std::string keys = shortcutText(shortcutOf(state, action));
    const bool checked = action.checked && action.checked(state);
    if (ImGui::MenuItem((label + "###" + action.id).c_str(), keys.c_str(), checked,
                        action.enabled(state)))
        runAction(state, action);
}

static void recentMenu(EditorState& state) {
    if (!ImGui::BeginMenu("Recent", !state.recent.empty()))
        return;
    for (const std::string& path : std::vector<std::string>(state.recent)) {
        const std::string name = std::filesystem::path(path).filename().string();
        if (ImGui::MenuItem((name + "##" + path).c_str()))
            state.requests.push_back({Request::Kind::Open, path});
        wrappedTooltip(path.c_str());
    }
    ImGui::EndMenu();
}

static void menu(EditorState& state, const char* label, Menu which) {
    if (!ImGui::BeginMenu(label))
        return;
    for (const Action& action : actions()) {
        if (action.menu != which)
            continue;
        if (action.separator)
            ImGui::Separator();
        actionItem(state, action);
        if (which == Menu::File && std::string_view(action.id) == "file.open")
            recentMenu(state);
    }
    if (which == Menu::Gizmo)
        snapSteps(state.view.gizmo);
    if (which == Menu::View) {
        menu(state, "Gizmo", Menu::Gizmo);
        menu(state, "Workspace", Menu::Workspace);
        menu(state, "Overlay", Menu::Overlay);
    }
    ImGui::EndMenu();
}

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
}

void menuBar(EditorState& state) {
    if (!ImGui::BeginMainMenuBar())
        return;
    menu(state, "File", Menu::File);
    menu(state, "Edit", Menu::Edit);
    menu(state, "Add", Menu::Add);
    menu(state, "View", Menu::View);
    menu(state, "Bake", Menu::Bake);
    menu(state, "Help", Menu::Help);
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

static void toolButton(EditorState& state, const char* id, const char* label) {
    const Action& action = actionById(id);
    const bool active = action.checked && action.checked(state);
    ImGui::BeginDisabled(!action.enabled(state));
    if (active)
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    if (ImGui::Button(label))
        runAction(state, action);
    if (active)
        ImGui::PopStyleColor();
    ImGui::EndDisabled();
    const std::string key = shortcutText(shortcutOf(state, action));
    wrappedTooltip((action.label + (key.empty() ? key : " (" + key + ")")).c_str());
    ImGui::SameLine();
}

/// Widths of the lists above the picture [em], which a narrow window shrinks by one factor.
struct BarWidths {
    float tool = 6, technique = 8, view = 7, overlay = 8, tonemap = 8, exposure = 8;

    /// `left`: width that they share [px].
    static BarWidths within(float left) {
        constexpr BarWidths kFull;
        constexpr float kSum = kFull.tool + kFull.technique + kFull.view + kFull.overlay +
                               kFull.tonemap + kFull.exposure;
        const float em =
            ImGui::GetFontSize() * std::clamp(left / (kSum * ImGui::GetFontSize()), 0.3f, 1.f);
        return {kFull.tool * em,    kFull.technique * em, kFull.view * em,
                kFull.overlay * em, kFull.tonemap * em,   kFull.exposure * em};
    }
};

static void toolCombo(EditorState& state, float width) {
    const Action* tools[] = {&actionById("tool.select"), &actionById("tool.move"),
                             &actionById("tool.rotate"), &actionById("tool.scale")};
    const auto chosen = std::ranges::find_if(tools, [&](auto* t) { return t->checked(state); });
    if (beginBarCombo("##tool", (*chosen)->label, "What the gizmo in the picture does (Q, W, E, R)",
                      width)) {
        for (const Action* tool : tools)
            actionItem(state, *tool);
        ImGui::EndCombo();
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

static void tonemapCombo(EditorState& state, float width) {
    static constexpr const char* kTonemaps[] = {"No tone mapping", "ACES fitted", "AgX",
                                                "Khronos PBR Neutral"};
    static_assert(std::size(kTonemaps) == kTonemapNames.size());
    valueCombo("##tonemap", state.view.tonemap, kTonemaps,
               "How scene light becomes display colours", width);
}

void viewBar(EditorState& state) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const bool saves = needsReference(state.compare.mode);
    const float buttons = ImGui::CalcTextSize(saves ? "RefEXR\u2026" : "Ref").x +
                          (saves ? 4 : 2) * style.FramePadding.x +
                          (saves ? 7 : 6) * style.ItemSpacing.x;
    const BarWidths widths = BarWidths::within(ImGui::GetContentRegionAvail().x - buttons);
    toolCombo(state, widths.tool);
    techniqueCombo(state, widths.technique);
    toolButton(state, "compare.reference", "Ref");
    if (saves)
        toolButton(state, "compare.save", "EXR\u2026");
    viewCombo(state, widths.view);
    overlayCombo(state, widths.overlay);
    ImGui::SameLine();
    tonemapCombo(state, widths.tonemap);
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
    if (toError)
        ImGui::Text("until %.2f", double(state.bakeError));
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
