// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// An octahedral map of all directions (engine/math/octahedral.h), side^2 texels.
struct Octahedron {
    std::uint32_t side;

    std::uint32_t texels() const { return side * side; }
    /// Unit direction of a texel's centre.
    glm::vec3 direction(std::uint32_t texel) const;
    /// The texel that contains direction `d`, which is not 0.
    std::uint32_t texelAt(glm::vec3 d) const;
    /// Solid angle of each texel [sr]; their sum is 4 pi.
    std::vector<float> solidAngles() const;
};

} // namespace limn
