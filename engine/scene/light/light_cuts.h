// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/rectangle_light.h"
#include "engine/scene/scene.h"

#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// Intersection of a triangle with the plane of a rectangle light: a segment within [-1, 1]^2 in
/// the light's coordinates.
struct LightCut {
    glm::vec2 a, b;
    /// Its dot product with an offset in these coordinates is > 0 in front of the triangle.
    glm::vec2 front;
    bool twoSided;
};

/// Intersections with all triangles of instances that are not cutouts. O(triangles).
std::vector<LightCut> lightCuts(const LightRectangle& light, const Scene& scene);

} // namespace limn
