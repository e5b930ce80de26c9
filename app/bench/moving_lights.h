// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"
#include "engine/techniques/illuminance/bake/bake.h"

#include <cstdint>
#include <vector>

namespace limn {

/// `count` point lights evenly over the surfaces, a twentieth of the scene's size off them.
std::vector<Light> pointsOver(const Scene& scene, const Surfels& surfels, std::uint32_t count);

/// The lights as they stand in the k-th of many runs: a sun turns, any other wanders, a little.
std::vector<Light> movedLights(std::vector<Light> lights, int k);

/// Where the dynamic instances are by then: on a circle of a twentieth of the scene's size, on
/// which each run is a tenth of a radian.
void moveObjects(Scene& scene, const Scene& standing, int k);

} // namespace limn
