// SPDX-License-Identifier: MIT
#include "editor_ui/panels/dialog.h"

#include <imgui.h>

#include <algorithm>

namespace limn {

bool beginDialog(const char* title) {
    if (!ImGui::IsPopupOpen(title))
        ImGui::OpenPopup(title);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(ImGui::GetFontSize() * 30, display.x * 0.95f), 0});
    return ImGui::BeginPopupModal(title, nullptr,
                                  ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize);
}

bool dialogButton(const char* label, int pressedKey) {
    const bool clicked = ImGui::Button(label);
    ImGui::SameLine();
    return clicked || (pressedKey != key::kNone && ImGui::IsKeyPressed(pressedKey));
}

} // namespace limn
