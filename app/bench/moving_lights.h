// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace limn {

/// Points of the static surfaces in world space, with unit normals.
struct SurfacePoints {
    std::vector<glm::vec3> positions, normals;
};

/// `count` points, each of which stands for the same area; none in a scene without static surfaces.
SurfacePoints spreadPoints(const Scene& scene, std::uint32_t count);

/// `count` point lights, each a twentieth of the scene's size away from a surface along its unit
/// normal. The surfaces are those of points at even steps through `positions`, which are spread
/// evenly over the scene.
std::vector<Light> pointsOver(const Scene& scene, std::span<const glm::vec3> positions,
                              std::span<const glm::vec3> normals, std::uint32_t count);

/// Moves the dynamic instances of `scene` to their places in run k: along a circle of a twentieth
/// of the scene's size, by a tenth of a radian per run.
void moveObjects(Scene& scene, const Scene& standing, int k);

} // namespace limn
