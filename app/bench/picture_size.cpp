// SPDX-License-Identifier: MIT
#include "app/bench/picture_size.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

namespace limn {

std::optional<glm::uvec2> pictureSize(const std::string& text) {
    glm::uvec2 size{0};
    char rest = 0;
    if (text.find('-') != std::string::npos ||
        std::sscanf(text.c_str(), "%5ux%5u%c", &size.x, &size.y, &rest) != 2 || size.x < 1 ||
        size.y < 1 || std::max(size.x, size.y) > 16384)
        return {};
    return size;
}

std::string pictureSizeDefect(const std::string& text) {
    return pictureSize(text) ? "" : fmt::format("\"{}\" is not WxH", text);
}

} // namespace limn
