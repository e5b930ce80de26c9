// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"
#include "engine/techniques/illuminance/bake/bake.h"

#include <cstdint>
#include <vector>

namespace limn {

/// `count` point lights spread evenly over the surfaces, a twentieth of the scene's size away from
/// them.
std::vector<Light> pointsOver(const Scene& scene, const Surfels& surfels, std::uint32_t count);

/// The lights as placed in run k: a directional light turns a little, any other moves a little.
std::vector<Light> movedLights(std::vector<Light> lights, int k);

/// Moves the dynamic instances of `scene` to their places in run k: along a circle of a twentieth
/// of the scene's size, by a tenth of a radian per run.
void moveObjects(Scene& scene, const Scene& standing, int k);

} // namespace limn
