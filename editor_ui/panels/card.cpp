// SPDX-License-Identifier: MIT
#include "editor_ui/panels/card.h"

#include "editor_ui/editor_state.h"

#include <imgui.h>

namespace limn {

bool card(EditorState& state, const char* title) {
    ImGui::Spacing();
    ImGui::SetNextItemOpen(!state.closedCards.contains(title));
    const bool open = ImGui::CollapsingHeader(title);
    if (open)
        state.closedCards.erase(title);
    else
        state.closedCards.insert(title);
    return open;
}

} // namespace limn
