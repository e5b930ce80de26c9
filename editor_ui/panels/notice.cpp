// SPDX-License-Identifier: MIT
#include "editor_ui/panels/notice.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/theme.h"

#include <imgui.h>

#include <algorithm>

namespace limn {

void noticeBox(EditorState& state) {
    if (!state.notice)
        return;
    const ViewState& view = state.view;
    const float margin = ImGui::GetFontSize() * 0.7f;
    const float width = std::clamp(view.size.x - 2 * margin, 1.f, ImGui::GetFontSize() * 36);
    ImGui::SetNextWindowPos({view.origin.x + view.size.x / 2, view.origin.y + margin},
                            ImGuiCond_Always, {0.5f, 0});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, std::max(view.size.y - margin, 1.f)});
    ImGui::PushStyleColor(ImGuiCol_Border, color::error());
    ImGui::Begin("notice", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PopStyleColor();
    ImGui::PushTextWrapPos(0);
    ImGui::TextColored(ImColor(color::error()), "%s", state.notice->title.c_str());
    ImGui::TextUnformatted(state.notice->text.c_str());
    ImGui::PopTextWrapPos();
    const bool dismissed = ImGui::Button("Dismiss");
    wrappedTooltip("Hides this message; the log keeps it");
    ImGui::End();
    if (dismissed)
        state.notice.reset();
}

} // namespace limn
