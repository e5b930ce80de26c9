// SPDX-License-Identifier: MIT
#include "editor_ui/panels/help_sheet.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/key_map.h"
#include "editor_ui/panels/menu.h"

#include <imgui.h>

#include <algorithm>
#include <string>
#include <utility>

namespace limn {

namespace {

struct Habit {
    const char *what, *how;
};
constexpr Habit kMouse[] = {
    {"Select", "Click; Ctrl or Shift adds"},
    {"Turn the view", "Middle button, or Alt and left button"},
    {"Shift the view", "Shift and middle button"},
    {"Zoom towards the mouse", "Wheel"},
    {"Fly", "Right button held, with W A S D, Q E; Shift fast, Ctrl slow, wheel for the speed"},
    {"Take a drag back", "Esc"},
    {"Snap a drag, or drag finely", "Ctrl; Shift"},
    {"Drag along one axis or two", "X, Y or Z; Shift and the one to leave out"},
    {"Drag by a number", "Digits, then Enter: metres, degrees or a factor"},
    {"Drag a copy", "Alt on a handle of the gizmo"},
    {"Type into a slider", "Ctrl and click, or double-click"}};

void row(const char* what, const std::string& how) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(what);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(how.c_str());
    ImGui::PopTextWrapPos();
}

void heading(const char* text) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", text);
}

std::string keysOf(const EditorState& state, const Action& action) {
    std::string text;
    for (const Shortcut& key : shortcutsOf(state, action))
        text += (text.empty() ? "" : ", ") + shortcutText(key);
    return text;
}

/// Draws the row of an action. After a click on it, the next key is assigned to the action.
void keyRow(EditorState& state, const Action& action) {
    std::string& assigning = state.palette.assigning;
    const bool waits = assigning == action.id;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(action.label);
    ImGui::PopTextWrapPos();
    ImGui::TableNextColumn();
    const std::string keys = waits ? "Press a key" : keysOf(state, action);
    if (ImGui::Selectable((keys + "###" + action.id).c_str(), waits,
                          ImGuiSelectableFlags_SpanAllColumns |
                              ImGuiSelectableFlags_DontClosePopups))
        assigning = waits ? std::string() : action.id;
    wrappedTooltip(waits ? "Esc: keep the old key. Backspace: no key"
                         : "Click, then press a new key for this");
}

void rows(EditorState& state) {
    heading("Mouse");
    for (const Habit& habit : kMouse)
        row(habit.what, habit.how);
    for (const MenuPlace& place : menuPlaces()) {
        if (place.parent)
            continue;
        heading(place.label);
        for (const Action& action : actions())
            if (topMenu(action.menu) == place.menu)
                keyRow(state, action);
    }
}

} // namespace

void helpSheet(EditorState& state) {
    if (std::exchange(state.palette.helpAsked, false))
        ImGui::OpenPopup("Keys and mouse");
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize(
        {std::min(font * 38, display.x), std::min(font * 40, display.y * 0.9f)});
    if (!ImGui::BeginPopup("Keys and mouse")) {
        state.palette.assigning.clear();
        return;
    }
    ImGui::TextUnformatted("Keys and mouse");
    wrappedTooltip("A click on a row gives its action a new key. Esc closes this sheet");
    ImGui::Separator();
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg)) {
        ImGui::TableSetupColumn("What", ImGuiTableColumnFlags_WidthStretch, 0.45f);
        ImGui::TableSetupColumn("How", ImGuiTableColumnFlags_WidthStretch, 0.55f);
        rows(state);
        ImGui::EndTable();
    }
    ImGui::EndPopup();
}

} // namespace limn
