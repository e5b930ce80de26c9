// SPDX-License-Identifier: MIT
#include "editor_ui/panels/bar_combo.h"

#include "editor_ui/panels/field.h"

#include <imgui.h>

#include <algorithm>

namespace limn {

bool beginBarCombo(const char* id, const std::string& shown, const char* tooltip, float width) {
    const float room =
        width - ImGui::GetFrameHeight() - 2 * ImGui::GetStyle().FramePadding.x; // beside the arrow
    const std::string fitting = elided(shown, std::max(room, 1.f));
    ImGui::SetNextItemWidth(width);
    const bool open = ImGui::BeginCombo(id, fitting.c_str(), ImGuiComboFlags_HeightLargest);
    if (!open)
        wrappedTooltip(fitting == shown ? tooltip : (shown + "\n" + tooltip).c_str());
    return open;
}

} // namespace limn
