// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// A function of direction by two bands of harmonics (sh.h), RGB.
using Lobe = std::array<glm::vec3, 4>;

/// The harmonics of a clamped cosine about unit n: kCosineMean, and kCosineSlope times n in the
/// order y, z, x.
inline constexpr float kCosineMean = 0.88622693f;  ///< sqrt(pi) / 2
inline constexpr float kCosineSlope = 1.02332671f; ///< sqrt(pi / 3)

/// A weighted clamped cosine in a cell.
struct LobeSample {
    std::uint32_t cell;
    glm::vec3 normal; ///< unit
    glm::vec3 weight;
};

/// A cell's sum of samples.
struct CellLobe {
    std::uint32_t cell;
    Lobe lobe{};
};

/// Sums samples by cell, in the order of the cells; cells without samples are left out. Samples of
/// a cell are added in their order, so that the result depends on no thread. `cells`: number of
/// cells.
std::vector<CellLobe> sumByCell(std::span<const LobeSample> samples, std::size_t cells);

} // namespace limn
