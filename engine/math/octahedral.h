// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

// The octahedral map of all directions to the square [-1, 1]^2: Cigolle et al. A Survey of
// Efficient Representations for Independent Unit Vectors. 2014. The direction d meets the
// octahedron |p|_1 = 1 at d / |d|_1; its upper half is seen from +z, the lower one is folded out.

/// The 1-norm |v|_1 = |x| + |y| + |z|.
inline float norm1(glm::vec3 v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// Place in the square of direction `d`, which must not be 0 but need not be of unit length.
inline glm::vec2 octahedralSquare(glm::vec3 d) {
    const glm::vec2 p = glm::vec2(d) / norm1(d);
    if (d.z < 0)
        return {std::copysign(1 - std::abs(p.y), d.x), std::copysign(1 - std::abs(p.x), d.y)};
    return p;
}

/// Point of the octahedron, |p|_1 = 1, at a place in the square.
inline glm::vec3 octahedralPoint(glm::vec2 square) {
    const float z = 1 - std::abs(square.x) - std::abs(square.y);
    const float fold = std::fmax(-z, 0.f);
    return {square.x - std::copysign(fold, square.x), square.y - std::copysign(fold, square.y), z};
}

} // namespace limn
