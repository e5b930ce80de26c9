// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include <glm/vec2.hpp>

namespace limn {

/// Width and height of a picture [pixels] from a text such as "320x180", both in [1, 16384]; none
/// if it is anything else.
std::optional<glm::uvec2> pictureSize(const std::string& text);

/// What is wrong with such a text; empty: nothing.
std::string pictureSizeDefect(const std::string& text);

} // namespace limn
