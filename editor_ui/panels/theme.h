// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <string>

namespace limn {

/// Colours that carry meaning. They are distinguished by hue and lightness and always accompanied
/// by words (colour-blind safe: blue, orange and light grey rather than red and green).
namespace color {
// Over the picture, on a dark ground.
inline constexpr ImU32 kAccent = IM_COL32(88, 156, 235, 255);
inline constexpr ImU32 kDim = IM_COL32(150, 153, 160, 255);
inline constexpr ImU32 kAxisX = IM_COL32(240, 80, 80, 255);
inline constexpr ImU32 kAxisY = IM_COL32(110, 205, 90, 255);
inline constexpr ImU32 kAxisZ = IM_COL32(90, 140, 255, 255);
inline constexpr ImU32 kGround = IM_COL32(20, 22, 26, 200); ///< that ground
inline constexpr ImU32 kHandleLit = IM_COL32(255, 225, 110, 255);
// In panels: as light or dark as the theme in use needs.
ImU32 accent();
ImU32 warning();
ImU32 error();
ImU32 good();
ImU32 dim();
} // namespace color

/// Height of the interface's font at 96 dpi, for which sizes in pixels are meant [px].
inline constexpr float kFontPixels = 15;

/// What sizes in pixels are multiplied by for the current font.
inline float uiScale() {
    return ImGui::GetFontSize() / kFontPixels;
}

/// Calm colours, dark at first, and even spacing for the current ImGui context, sized for a 15 px
/// font.
void applyTheme();

/// Colours of the dark or the light theme for the current ImGui context. Cheap: for every frame.
void setThemeColors(bool light);

/// Adds the interface font to the atlas: DejaVuSans.ttf in the folder `fonts`, else the system's,
/// else ImGui's own, which lacks Greek letters and superscripts. Returns the file used; empty for
/// ImGui's own.
std::string addFont(float pixels, const std::string& fonts);

} // namespace limn
