// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"

namespace limn {

/// How a cluster tree is formed. Of its surfels; the sky's cells are not counted.
struct TreeShape {
    std::uint32_t maxDepth = 0; ///< edges from the root to the furthest surfel
    double meanDepth = 0;       ///< over the surfels; at least log2(surfels)
    double balance = 1;         ///< mean over the inner nodes of fewer / more leaves; 1: all halve
};
TreeShape treeShapeOf(const ClusterTree& tree);

} // namespace limn
