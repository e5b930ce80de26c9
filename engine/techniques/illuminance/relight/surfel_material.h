// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Computes the albedo of each surfel, at most 0.99, and its emission, pi L_e [W m^-2], as means
/// over the surface that it stands for. Both get one entry per surfel. `known`: the materials of
/// the values that both already hold; only surfels whose materials differ from those are looked up.
void surfelMaterials(const Surfels& surfels, const Scene& scene, std::vector<glm::vec3>& albedo,
                     std::vector<glm::vec3>& emitted, std::span<const Material> known = {});

/// Radiosity of the tree's sky cells: pi times the sky's radiance in each [W m^-2].
std::vector<glm::vec3> skyRadiosity(const ClusterTree& tree, const Sky& sky);

} // namespace limn
