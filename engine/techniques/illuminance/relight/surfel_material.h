// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Per surfel its albedo, at most 0.99, and what it emits, pi L_e [W m^-2]: means over the surface
/// it stands for. Fills both to the surfels' number. `known`: the materials that both hold already;
/// only surfels of materials that differ from those are looked up.
void surfelMaterials(const Surfels& surfels, const Scene& scene, std::vector<glm::vec3>& albedo,
                     std::vector<glm::vec3>& emitted, std::span<const Material> known = {});

/// Radiosity of the tree's sky cells: pi times the sky's radiance in each [W m^-2].
std::vector<glm::vec3> skyRadiosity(const ClusterTree& tree, const Sky& sky);

} // namespace limn
