// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/packing.h"
#include "engine/techniques/illuminance/format/bake.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include <glm/geometric.hpp>

namespace limn {

/// The cone of directions that a link's light comes through.
struct LinkCone {
    std::uint32_t node = 0;
    glm::vec3 direction{0, 0, 1}; ///< of any length
    float u = 0;                  ///< 1 - cos(half-angle)
};

/// Recovers the cone of link k of LinkStorage::Sh, whose links have `coefficients` = bands^2 each,
/// from the first two bands of a cone: transport Y_00 and transport (2 - u) / 2 Y_1m. Returns all
/// directions where the link carries nothing.
inline LinkCone coneOfHarmonics(const Caches& caches, std::size_t k, std::size_t coefficients) {
    const std::uint16_t* h = caches.shCoefficients.data() + k * coefficients;
    const glm::vec3 first(halfToFloat(h[3]), halfToFloat(h[1]), halfToFloat(h[2]));
    const float length = glm::length(first), zeroth = halfToFloat(h[0]);
    if (!(length > 0) || !(zeroth > 0))
        return {caches.shNode[k], {0, 0, 1}, 2};
    const float u = 2 * (1 - length / (std::numbers::sqrt3_v<float> * zeroth));
    return {caches.shNode[k], first, std::clamp(u, 0.f, 2.f)};
}

} // namespace limn
