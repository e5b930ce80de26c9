// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include <glm/vec3.hpp>

namespace limn {

/// Relative luminance of a linear Rec. 709 colour, in the colour's unit.
template <class T>
constexpr T luminance(glm::vec<3, T> rgb) {
    return T(0.2126) * rgb.x + T(0.7152) * rgb.y + T(0.0722) * rgb.z;
}

/// The largest of the three channels of a colour.
constexpr float largestChannel(glm::vec3 rgb) {
    return std::max({rgb.x, rgb.y, rgb.z});
}

} // namespace limn
