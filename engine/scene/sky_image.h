// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/image.h"

#include <cstdint>
#include <vector>

namespace limn {

// A panorama: latitude-longitude, row 0 straight up. Its middle is -Z, a quarter to the right of it
// +X. Turned about +Y by `rotation` [rad], from +Z towards +X. Each pixel is one radiance [nits].

/// Radiance of a panorama that is not empty in direction `d` (unit).
glm::vec3 skyRadiance(const ImageF& panorama, float rotation, glm::vec3 d);

/// Means over `bands` bands of equal height on the unit sphere, so of equal solid angle, per column
/// of the panorama: band b from the lowest on is mean[b * columns + column].
struct SkyBands {
    std::uint32_t bands = 0, columns = 0;
    std::vector<glm::dvec3> mean;
};
SkyBands skyBands(const ImageF& panorama, std::uint32_t bands);

/// Mean radiance of each cell of a sky of bands by sectors, as skyCellOf() numbers them: the exact
/// integral of the turned panorama, so that all cells together send what it sends.
/// O(bands * columns).
std::vector<glm::vec3> skyCellRadiance(const SkyBands& bands, std::uint32_t sectors,
                                       float rotation);

} // namespace limn
