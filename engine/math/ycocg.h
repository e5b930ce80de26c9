// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

namespace limn {

/// A colour as luma and two chrominances: Y = R/4 + G/2 + B/4, Co = (R - B)/2, Cg = -R/4 + G/2 -
/// B/4. Grey has exactly zero chrominance, and its luma equals its R exactly.
/// Malvar and Sullivan. YCoCg-R: A Color Space with RGB Reversibility and Low Dynamic Range. 2003
struct YCoCg {
    float y, co, cg;
};

inline YCoCg toYCoCg(glm::vec3 c) {
    const float sides = (c.x + c.z) * 0.25f, middle = c.y * 0.5f;
    return {middle + sides, (c.x - c.z) * 0.5f, middle - sides};
}

inline glm::vec3 toRgb(YCoCg c) {
    return {c.y + c.co - c.cg, c.y + c.cg, c.y - c.co - c.cg};
}

} // namespace limn
