// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <imgui.h>

namespace limn {

/// The dark background of a label, beyond its text [px].
struct LabelFrame {
    ImVec2 margin{5, 2};
    float rounding = 3;
};

/// Draws text over the picture, on a dark background, wrapped at `width` [px]; 0: not wrapped.
/// `align`, as a share of the text's size, is the point of it that lies at `position`: (0, 0) is
/// the upper left corner. Returns the text's size [px].
ImVec2 pictureLabel(ImVec2 position, ImVec2 align, const std::string& text, ImU32 ink,
                    float width = 0, const LabelFrame& frame = {});

} // namespace limn
