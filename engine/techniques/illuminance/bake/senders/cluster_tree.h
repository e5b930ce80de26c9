// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/senders/surfels.h"

namespace limn {

/// Number of sky cells. Each is a sender, and all have equal solid angle.
inline constexpr std::uint32_t kSkyCells = 256;

/// Sky cell in direction `d` (unit). Cells are sectors about +Y of equal-area bands of height.
std::uint32_t skyCellOf(glm::vec3 d);

/// Unit direction of the middle of a cell. `cell` < kSkyCells.
glm::vec3 skyCellDirection(std::uint32_t cell);

/// Builds the tree of all senders. It joins a tree over the instances and one over the sky cells at
/// the root; each instance uses its mesh's tree, built once in object space. Surfels and instances
/// are clustered as Scene::bake says, with the diagonal of the mesh's surfels, or of the scene, as
/// the metric's extent. leftWeight is by area. Trees of meshes found in `store` are reused. Empty
/// when cancelled.
ClusterTree buildClusterTree(const Scene& scene, const SurfelSet& set,
                             const Progress& progress = {}, StageStore* store = nullptr);

/// Fills leftWeight, by area, and parent from the children.
void fillWeightsAndParents(const Surfels& surfels, ClusterTree& tree);

/// Per node, true where all leaves below it are sky cells. Links to such nodes bring no light while
/// the sky is black.
std::vector<bool> skyNodes(const ClusterTree& tree);

} // namespace limn
