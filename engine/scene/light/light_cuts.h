// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/rectangle_light.h"
#include "engine/scene/scene.h"

#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// Where a triangle cuts the plane of a rectangle light, in the light's coordinates: a segment
/// within
/// [-1, 1]^2.
struct LightCut {
    glm::vec2 a, b;
    glm::vec2 front; ///< times an offset in these coordinates: > 0 before the triangle
    bool twoSided;
};

/// The cuts of all triangles of instances that are not cutouts. O(triangles).
std::vector<LightCut> lightCuts(const LightRectangle& light, const Scene& scene);

} // namespace limn
