// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <string>

namespace limn {

/// Nothing may lie further from the file's origin along an axis [m]: squares of distances stay
/// within float, and doubles tell tenths of a millimetre apart there.
inline constexpr float kMaxCoordinate = 1e12f;

/// Whether no coordinate is NaN or beyond kMaxCoordinate.
bool withinReach(glm::vec3 p);

/// What of a scene lies beyond kMaxCoordinate once it is placed, in words: its meshes, a light, a
/// camera. Empty: nothing does. O(instances); the scene's bounds must be set.
std::string reachDefect(const Scene& scene);

} // namespace limn
