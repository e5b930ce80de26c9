// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"

namespace limn {

/// Shape of a cluster tree over its surfels; sky cells are not counted.
struct TreeShape {
    std::uint32_t maxDepth = 0; ///< edges from the root to the furthest surfel
    double meanDepth = 0;       ///< over the surfels; at least log2(surfels)
    double balance = 1; ///< mean over inner nodes of fewer / more leaves of a child; 1: all equal
};
TreeShape treeShapeOf(const ClusterTree& tree);

} // namespace limn
