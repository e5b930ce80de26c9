// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/image.h"

#include <cstdint>
#include <vector>

namespace limn {

// A panorama is a latitude-longitude image with row 0 straight up. Its middle faces -Z, and a
// quarter of the width to the right of it faces +X. It is turned about +Y by `rotation` [rad], from
// +Z towards +X. Each pixel is one radiance [nits].

/// Radiance of a non-empty panorama in direction `d` (unit).
glm::vec3 skyRadiance(const ImageF& panorama, float rotation, glm::vec3 d);

/// Means per column of the panorama over `bands` bands of equal height on the unit sphere, hence of
/// equal solid angle. Band b, counted from the lowest, is mean[b * columns + column].
struct SkyBands {
    std::uint32_t bands = 0, columns = 0;
    std::vector<glm::dvec3> mean;
};
SkyBands skyBands(const ImageF& panorama, std::uint32_t bands);

/// Mean radiance of each cell of a sky of bands by sectors, numbered by skyCellOf(). It is the
/// exact integral of the rotated panorama, so the cells together emit as much as the panorama.
/// O(bands * columns).
std::vector<glm::vec3> skyCellRadiance(const SkyBands& bands, std::uint32_t sectors,
                                       float rotation);

} // namespace limn
