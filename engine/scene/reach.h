// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <string>

namespace limn {

/// Maximum distance from the file's origin along an axis [m]. Squares of distances stay within
/// float, and doubles distinguish tenths of a millimetre there.
inline constexpr float kMaxCoordinate = 1e12f;

/// Whether all coordinates are finite and within kMaxCoordinate.
bool withinReach(glm::vec3 p);

/// Describes which part of a placed scene lies beyond kMaxCoordinate: a mesh, a light or a camera.
/// Empty if none does. O(instances); the scene's bounds must be set.
std::string reachDefect(const Scene& scene);

} // namespace limn
