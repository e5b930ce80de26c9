// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/image.h"

#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// A rectangle of a screen [px].
struct ScreenRect {
    glm::vec2 origin{0}, size{0};

    glm::vec2 middle() const { return origin + size / 2.f; }
};

/// Places where `text` stands on the screen as the current ImGui context draws it, whatever its
/// colour and that of the even ground below it; rows from the top. Text that is cut off, elided or
/// partly covered is not found. `within`: no further than this; of size 0: anywhere.
/// Normalised cross-correlation of luminance, with the mean of the text's own rectangle removed.
std::vector<ScreenRect> findText(const Image& screen, const std::string& text,
                                 const ScreenRect& within = {});

/// Whether nothing stands close behind the text: it is a whole label and not the beginning of a
/// longer one.
bool endsThere(const Image& screen, const ScreenRect& text);

} // namespace limn
