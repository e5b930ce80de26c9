// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/illuminance/bake/senders/surfels.h"
#include "engine/techniques/illuminance/format/sky_cells.h"

namespace limn {

/// Builds the tree of all senders. It joins a tree over the instances and one over the sky cells at
/// the root; each instance uses its mesh's tree, built once in object space. Surfels and instances
/// are clustered as Scene::bake says, with the diagonal of the mesh's surfels, or of the scene, as
/// the metric's extent. leftWeight is by area. Trees of meshes found in `store` are reused. Empty
/// when cancelled.
ClusterTree buildClusterTree(const Scene& scene, const SurfelSet& set,
                             const Progress& progress = {}, StageStore* store = nullptr);

/// Fills leftWeight, by area, and parent from the children.
void fillWeightsAndParents(const Surfels& surfels, ClusterTree& tree);

} // namespace limn
