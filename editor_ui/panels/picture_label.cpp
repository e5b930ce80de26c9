// SPDX-License-Identifier: MIT
#include "editor_ui/panels/picture_label.h"

#include "editor_ui/panels/theme.h"

namespace limn {

ImVec2 pictureLabel(ImVec2 position, ImVec2 align, const std::string& text, ImU32 ink, float width,
                    const LabelFrame& frame) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width > 0 ? width : -1);
    position = {position.x - align.x * size.x, position.y - align.y * size.y};
    const auto [mx, my] = frame.margin;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({position.x - mx, position.y - my},
                       {position.x + size.x + mx, position.y + size.y + my}, color::kGround,
                       frame.rounding);
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), position, ink, text.c_str(), nullptr,
                 width);
    return size;
}

} // namespace limn
