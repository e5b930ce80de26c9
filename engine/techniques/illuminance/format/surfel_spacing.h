// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"

#include <cmath>
#include <cstdint>

namespace limn {

/// Distance between neighbours of a hexagonal lattice whose points each stand for `area`.
inline float hexagonalSpacing(float area) {
    return std::sqrt(2 * area / std::sqrt(3.f));
}

/// How evenly surfels are spread: each one's distance to its nearest neighbour, over
/// hexagonalSpacing() of its area.
/// Random points on a plane: mean 0.465, spread 0.523. A hexagonal lattice: 1 and 0.
struct SurfelSpacing {
    double mean = 0;         ///< of that ratio [1]
    double spread = 0;       ///< its standard deviation / mean [1]
    std::uint64_t count = 0; ///< surfels that have a neighbour and an area
};

/// Measures how evenly surfels are spread. Neighbours are surfels of the same instance whose
/// normals are less than a right angle apart.
SurfelSpacing surfelSpacing(const Surfels& surfels);

} // namespace limn
