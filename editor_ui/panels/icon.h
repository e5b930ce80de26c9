// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

namespace limn {

enum class Icon {
    Group,
    Mesh,
    Sun,
    Point,
    Spot,
    Rectangle,
    Material,
    Camera,
    Sky,
    Settings,
    Shown,
    Hidden,
    Pointer,
    Move,
    Rotate,
    Scale
};

/// Draws a line icon of `size` pixels, centred; needs no font.
void drawIcon(ImDrawList& list, Icon icon, ImVec2 centre, float size, ImU32 color);

/// Draws the icon as an ImGui item as high as a line of text.
void iconItem(Icon icon, ImU32 color);

} // namespace limn
