// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"
#include "shaders/shared/gpu_relight.h"

#include <cstdint>
#include <vector>

namespace limn {

/// The inner nodes of a tree sorted into levels. The children of a node lie in earlier levels than
/// its own, so all nodes of a level can be computed in parallel.
struct TreeLevels {
    std::vector<shared::GpuInnerNode> nodes; ///< within a level in the order of the tree
    std::vector<std::uint32_t> begin;        ///< first node of each level, then the number of nodes

    std::uint32_t count() const { return std::uint32_t(begin.size() - 1); }
    std::uint32_t size(std::uint32_t level) const { return begin[level + 1] - begin[level]; }
};

/// Sorts the inner nodes into the minimum number of levels: each lies one above the higher of its
/// children's.
TreeLevels treeLevels(const ClusterTree& tree);

} // namespace limn
