// SPDX-License-Identifier: MIT
#include "editor_ui/panels/picture_label.h"

#include "editor_ui/panels/theme.h"

namespace limn {

ImVec2 pictureLabel(ImVec2 at, ImVec2 align, const std::string& text, ImU32 ink, float width,
                    const LabelFrame& frame) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width > 0 ? width : -1);
    at = {at.x - align.x * size.x, at.y - align.y * size.y};
    const auto [mx, my] = frame.margin;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({at.x - mx, at.y - my}, {at.x + size.x + mx, at.y + size.y + my},
                       color::kGround, frame.rounding);
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), at, ink, text.c_str(), nullptr, width);
    return size;
}

} // namespace limn
