// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/octahedron.h"

#include "engine/math/octahedral.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace limn {

/// Centre of a texel on the octahedron |p|_1 = 1.
static glm::vec3 pointOf(std::uint32_t side, std::uint32_t texel) {
    return octahedralPoint(
        (glm::vec2(float(texel % side), float(texel / side)) + 0.5f) * (2.f / float(side)) - 1.f);
}

glm::vec3 Octahedron::direction(std::uint32_t texel) const {
    return glm::normalize(pointOf(side, texel));
}

std::uint32_t Octahedron::texelAt(glm::vec3 d) const {
    const glm::vec2 p = octahedralSquare(d);
    const auto cell = [&](float v) {
        return std::min(std::uint32_t(std::max((v * 0.5f + 0.5f) * float(side), 0.f)), side - 1);
    };
    return cell(p.y) * side + cell(p.x);
}

std::vector<float> Octahedron::solidAngles() const {
    // All faces have the same distance from the middle, so a texel's solid angle falls with the
    // third power of its own distance: two for the distance, one for the cosine.
    constexpr std::uint32_t kParts = 4; // of a texel's side; folds cross texels
    std::vector<double> share(texels());
    double sum = 0;
    for (std::uint32_t part = 0; part < texels() * kParts * kParts; ++part) {
        const double one = std::pow(double(glm::length(pointOf(kParts * side, part))), -3);
        const std::uint32_t x = part % (kParts * side) / kParts,
                            y = part / (kParts * side) / kParts;
        share[y * side + x] += one;
        sum += one;
    }
    std::vector<float> result;
    for (const double s : share)
        result.push_back(float(4 * std::numbers::pi * s / sum));
    return result;
}

} // namespace limn
