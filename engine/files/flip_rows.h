// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/image.h"

#include <algorithm>
#include <cstddef>

namespace limn {

/// Turns an image upside down.
inline void flipRows(ImageF& image) {
    const auto row = [&](std::uint32_t y) {
        return image.rgb.begin() + std::ptrdiff_t(y) * image.width;
    };
    for (std::uint32_t y = 0; y < image.height / 2; ++y)
        std::swap_ranges(row(y), row(y + 1), row(image.height - 1 - y));
}

} // namespace limn
