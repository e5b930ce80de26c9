// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/export/export_format.h"
#include "engine/scene/image.h"

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

namespace limn {

// Radiance from all directions [W m^-2 sr^-1] as latitude-longitude images with row 0 straight up.
// Their middle faces +X, and a quarter of the width to the left of it -Z, as three.js and Blender
// have them.

/// Unit direction to the middle of pixel row * width + column.
glm::vec3 panoramaDirection(std::uint32_t width, std::uint32_t height, std::size_t pixel);

/// The sky in as many pixels as its kind deserves, 1024 x 512 at most; without pixels where it is
/// black.
ImageF skyPanorama(const Sky& sky);

/// What is seen from `p`, as cubeSeenFrom() has it. Incomplete when cancelled.
ImageF panoramaSeenFrom(const ExportScene& scene, glm::vec3 p, std::uint32_t width,
                        std::uint32_t height, const Progress& progress);

} // namespace limn
