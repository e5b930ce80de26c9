// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// `v` with length 1, or `fallback` where it is 0. The squares of very short and very long vectors
/// lie beyond floats: these are scaled by a power of two first, which changes no bit of the result.
inline glm::vec3 unitOr(glm::vec3 v, glm::vec3 fallback) {
    constexpr float kSmall = 1e-30f, kLarge = 1e30f;
    const float square = glm::dot(v, v);
    if (square > kSmall && square < kLarge)
        return v / std::sqrt(square);
    const float largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0) || !std::isfinite(largest))
        return fallback;
    v *= std::exp2(-float(std::ilogb(largest)));
    return v / glm::length(v);
}

} // namespace limn
