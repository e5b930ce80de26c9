// SPDX-License-Identifier: MIT
#include "editor_ui/panels/color_field.h"

#include "editor_ui/panels/field.h"
#include "engine/scene/tone_map.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace limn {

/// What the colour is divided by for display.
static float displayScale(glm::vec3 linear) {
    return std::max({linear.x, linear.y, linear.z, 1.f});
}

/// Inverse of encodeSrgb(), IEC 61966-2-1.
static float decodeSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

glm::vec3 displayedColor(glm::vec3 linear) {
    const glm::vec3 c = glm::max(linear, 0.f) / displayScale(linear);
    return {encodeSrgb(c.x), encodeSrgb(c.y), encodeSrgb(c.z)};
}

glm::vec3 linearOfDisplayed(glm::vec3 displayed, glm::vec3 linear) {
    const glm::vec3 d = glm::clamp(displayed, 0.f, 1.f);
    return displayScale(linear) * glm::vec3(decodeSrgb(d.x), decodeSrgb(d.y), decodeSrgb(d.z));
}

bool colorField(const char* id, glm::vec3& linear) {
    ImGui::PushID(id);
    ImGui::BeginGroup();
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float numbers = ImGui::CalcItemWidth() - ImGui::GetFrameHeight() - gap;
    ImGui::SetNextItemWidth(std::max(numbers, 1.f));
    bool edited = ImGui::DragFloat3("##linear", &linear.x, 0.005f, 0, 0, "%.3f");
    wrappedTooltip("Red, green and blue, linear Rec. 709");
    glm::vec3 displayed = displayedColor(linear);
    ImGui::SameLine(0, gap);
    if (ImGui::ColorButton("##swatch", {displayed.x, displayed.y, displayed.z, 1},
                           ImGuiColorEditFlags_NoAlpha | ImGuiColorEditFlags_NoTooltip |
                               ImGuiColorEditFlags_NoDragDrop))
        ImGui::OpenPopup("picker");
    wrappedTooltip("The colour as the screen shows it. Click to choose another, or to type its "
                   "sRGB code, such as #FF8040");
    if (ImGui::BeginPopup("picker")) {
        ImGui::SetNextItemWidth(ImGui::GetFontSize() * 14);
        if (ImGui::ColorPicker3("##picker", &displayed.x,
                                ImGuiColorEditFlags_NoSidePreview |
                                    ImGuiColorEditFlags_NoSmallPreview |
                                    ImGuiColorEditFlags_NoLabel | ImGuiColorEditFlags_DisplayRGB |
                                    ImGuiColorEditFlags_DisplayHex)) {
            linear = linearOfDisplayed(displayed, linear);
            edited = true;
        }
        ImGui::EndPopup();
    }
    ImGui::EndGroup();
    ImGui::PopID();
    return edited;
}

} // namespace limn
