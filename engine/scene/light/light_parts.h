// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <vector>

namespace limn {

/// At most so many parts of one light.
inline constexpr std::size_t kMaxLightParts = 16;

/// A light of kind Rectangle, parted where surfaces cut through it: rectangles round what they
/// enclose of it, the one with its centre first, then the largest, and what is left beside these.
/// Shadows drawn from points on the parts then are those in the room that each lights, however far
/// beyond the walls the light reaches. What lies within a solid, and what sticks out of a wall by
/// half a percent of the light, is left out. The light itself where nothing cuts it to pieces, and
/// where such rectangles would overlap: a wall lies askew across it. O(triangles).
std::vector<Light> partsBetweenWalls(const Light& light, const Scene& scene);

} // namespace limn
