// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <vector>

namespace limn {

/// Maximum number of parts of one light.
inline constexpr std::size_t kMaxLightParts = 16;

/// Splits a light of kind Rectangle where surfaces cut through it. The parts are the bounding
/// rectangles of the regions that the surfaces enclose: first the one that contains the light's
/// centre, then the largest ones, then what remains beside these. Shadow rays to points on a part
/// are then valid for the room that the part lights, however far beyond the walls the light
/// reaches. Regions within a solid, and regions that stick out of a wall by half a percent of the
/// light, are left out. Returns the light itself if nothing cuts it, or if the rectangles would
/// overlap because a wall crosses it at an angle. O(triangles).
std::vector<Light> partsBetweenWalls(const Light& light, const Scene& scene);

} // namespace limn
