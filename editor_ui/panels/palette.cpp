// SPDX-License-Identifier: MIT
#include "editor_ui/panels/palette.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/theme.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace limn {

static std::string lower(std::string s) {
    std::ranges::transform(s, s.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return s;
}

static std::vector<const Action*> matchingActions(const EditorState& state) {
    const std::string filter = lower(state.palette.filter);
    std::vector<const Action*> found;
    for (const Action& action : actions())
        if (action.enabled(state) && (lower(action.label).find(filter) != std::string::npos ||
                                      lower(action.id).find(filter) != std::string::npos))
            found.push_back(&action);
    return found;
}

/// Moves the chosen row by the arrow keys; returns true if it moved.
static bool moveChosen(Palette& palette, int rows) {
    const int step = int(ImGui::IsKeyPressed(key::kDown)) - int(ImGui::IsKeyPressed(key::kUp));
    palette.chosen = std::clamp(palette.chosen + step, 0, std::max(rows - 1, 0));
    return step != 0;
}

/// Returns the action that was clicked, or null.
static const Action* rows(const EditorState& state, const std::vector<const Action*>& found,
                          int chosen, bool scroll) {
    const Action* clicked = nullptr;
    for (int i = 0; i < int(found.size()); ++i) {
        const Action& action = *found[std::size_t(i)];
        if (ImGui::Selectable((std::string(action.label) + "###" + action.id).c_str(), i == chosen))
            clicked = &action;
        if (i == chosen && scroll)
            ImGui::SetScrollHereY();
        const std::string keys = shortcutText(shortcutOf(state, action));
        ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(keys.c_str()).x);
        ImGui::TextDisabled("%s", keys.c_str());
    }
    if (found.empty())
        ImGui::TextDisabled("No action matches");
    return clicked;
}

void palettePopup(EditorState& state) {
    Palette& palette = state.palette;
    if (palette.open) {
        ImGui::OpenPopup("All actions");
        palette = {};
    }
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x / 2, display.y * 0.15f}, ImGuiCond_Always, {0.5f, 0});
    const float size = 420 * uiScale();
    ImGui::SetNextWindowSize({std::min(size, display.x), std::min(size, display.y * 0.7f)});
    if (!ImGui::BeginPopup("All actions"))
        return;
    if (ImGui::IsWindowAppearing())
        ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-FLT_MIN);
    const std::string before = palette.filter;
    const bool enter =
        ImGui::InputTextWithHint("##filter", "Type to find an action", &palette.filter,
                                 ImGuiInputTextFlags_EnterReturnsTrue);
    if (palette.filter != before)
        palette.chosen = 0;
    const std::vector<const Action*> found = matchingActions(state);
    const bool moved = moveChosen(palette, int(found.size()));
    const Action* run = nullptr;
    if (ImGui::BeginChild("list"))
        run = rows(state, found, palette.chosen, moved);
    ImGui::EndChild();
    if (enter && !found.empty())
        run = found[std::size_t(palette.chosen)];
    if (run)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (run)
        runAction(state, *run);
}

} // namespace limn
