// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/senders/surfels.h"

namespace limn {

/// Number of sky cells: a sender for each, of equal solid angle.
inline constexpr std::uint32_t kSkyCells = 256;

/// The cell of the sky in direction `d` (unit): equal-area bands of height by sectors about +Y.
std::uint32_t skyCellOf(glm::vec3 d);

/// The middle of a cell, unit. `cell` < kSkyCells.
glm::vec3 skyCellDirection(std::uint32_t cell);

/// Trees per mesh, built once in object space and used by each instance, a tree over the instances,
/// and one over the sky cells, joined at the root. Surfels and instances are clustered as
/// Scene::bake says, with the diagonal of the mesh's surfels, or of the scene, as the metric's
/// extent. leftWeight is by area. Empty when cancelled.
/// Trees of meshes that `store` knows are not built again.
ClusterTree buildClusterTree(const Scene& scene, const SurfelSet& set,
                             const Progress& progress = {}, StageStore* store = nullptr);

/// Fills leftWeight by area, and parent, from the children.
void fillWeightsAndParents(const Surfels& surfels, ClusterTree& tree);

/// Per node whether nothing but sky is below it: a link to it brings nothing while the sky is
/// black.
std::vector<bool> skyNodes(const ClusterTree& tree);

} // namespace limn
