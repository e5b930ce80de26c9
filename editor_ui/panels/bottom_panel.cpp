// SPDX-License-Identifier: MIT
#include "editor_ui/panels/bottom_panel.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/error_panel.h"
#include "editor_ui/panels/explain_panel.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/lint_panel.h"
#include "editor_ui/panels/mixer_panel.h"
#include "editor_ui/panels/statistics_panel.h"
#include "editor_ui/panels/theme.h"

#include <imgui.h>

#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

struct TabText {
    const char *label, *tooltip;
};

constexpr TabText kTabs[] = {
    {"Lights", "Every light with its switch, colour, strength and share of a pixel"},
    {"Explain", "Where the light of a clicked pixel comes from"},
    {"Check", "What in the scene makes its light go wrong"},
    {"Profile", "What updates of light, the picture and the window's frames took"},
    {"Memory", "What the bake holds, its counts and its stages"},
    {"Error", "The error against the reference since the last edit"},
    {"Log", "What was opened, saved, repaired and what went wrong"}};
static_assert(std::size(kTabs) == kBottomTabNames.size());

} // namespace

float closedBottomHeight() {
    return ImGui::GetFrameHeight() + 12 * uiScale();
}

static std::string tabLabel(const EditorState& state, BottomTab tab) {
    const char* label = kTabs[std::size_t(tab)].label;
    return tab == BottomTab::Log ? fmt::format("{} ({})###log", label, state.log.size()) : label;
}

static void toggleArrow(LayoutState& layout) {
    if (ImGui::ArrowButton("##open", layout.bottomOpen ? ImGuiDir_Down : ImGuiDir_Up))
        layout.bottomOpen = !layout.bottomOpen;
    wrappedTooltip(layout.bottomOpen ? "Closes this panel" : "Opens this panel");
}

static void tabButton(EditorState& state, BottomTab tab) {
    LayoutState& layout = state.layout;
    const bool shown = layout.bottomOpen && layout.tab == tab;
    ImGui::PushStyleColor(ImGuiCol_Button,
                          ImGui::GetStyleColorVec4(shown ? ImGuiCol_TabActive : ImGuiCol_Tab));
    const bool clicked = ImGui::Button(tabLabel(state, tab).c_str());
    ImGui::PopStyleColor();
    wrappedTooltip(kTabs[std::size_t(tab)].tooltip);
    if (!clicked)
        return;
    layout.bottomOpen = !shown;
    layout.tab = tab;
}

static void tabContents(EditorState& state) {
    switch (state.layout.tab) {
    case BottomTab::Lights:
        state.explain.shown = true; // shares are those of the pixel that is clicked
        mixerPanel(state);
        break;
    case BottomTab::Explain:
        state.explain.shown = state.explain.mutes = true;
        explainPanel(state);
        break;
    case BottomTab::Check:
        lintPanel(state);
        break;
    case BottomTab::Profile:
        profilePanel(state);
        break;
    case BottomTab::Memory:
        memoryPanel(state);
        break;
    case BottomTab::Error:
        errorPanel(state);
        break;
    case BottomTab::Log:
        logPanel(state);
        break;
    }
}

void bottomPanel(EditorState& state) {
    state.explain.shown = state.explain.mutes = false;
    state.explain.hovered = 0;
    if (std::exchange(state.explain.bringUp, false)) {
        state.layout.bottomOpen = true;
        state.layout.tab = BottomTab::Explain;
    }
    toggleArrow(state.layout);
    for (std::size_t i = 0; i < std::size(kTabs); ++i) {
        ImGui::SameLine();
        tabButton(state, BottomTab(i));
    }
    if (!state.layout.bottomOpen)
        return;
    ImGui::Separator();
    ImGui::PushID(int(state.layout.tab));
    tabContents(state);
    ImGui::PopID();
}

} // namespace limn
