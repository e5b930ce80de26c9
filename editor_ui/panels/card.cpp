// SPDX-License-Identifier: MIT
#include "editor_ui/panels/card.h"

#include "editor_ui/editor_state.h"

#include <imgui.h>

namespace limn {

bool card(EditorState& state, const char* title) {
    ImGui::Spacing();
    ImGui::SetNextItemOpen(!state.closedCards.contains(title));
    // The accent marks what is selected; a header is not.
    const ImVec4 ground = ImGui::GetStyleColorVec4(ImGuiCol_Button);
    ImGui::PushStyleColor(ImGuiCol_Header, ground);
    ImGui::PushStyleColor(ImGuiCol_HeaderHovered, ImGui::GetStyleColorVec4(ImGuiCol_ButtonHovered));
    ImGui::PushStyleColor(ImGuiCol_HeaderActive, ground);
    const bool open = ImGui::CollapsingHeader(title);
    ImGui::PopStyleColor(3);
    if (open)
        state.closedCards.erase(title);
    else
        state.closedCards.insert(title);
    return open;
}

} // namespace limn
