// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"
#include "shaders/shared/gpu_relight.h"

#include <cstdint>
#include <vector>

namespace limn {

/// The inner nodes of a tree, level after level: the children of a node lie in levels before its
/// own, so that all nodes of a level can be worked out at once.
struct TreeLevels {
    std::vector<shared::GpuInnerNode> nodes; ///< within a level as in the tree
    std::vector<std::uint32_t> begin; ///< of each level among `nodes`; the last is their number

    std::uint32_t count() const { return std::uint32_t(begin.size() - 1); }
    std::uint32_t size(std::uint32_t level) const { return begin[level + 1] - begin[level]; }
};

/// As few levels as there can be: a node's is one above the higher of its children's.
TreeLevels treeLevels(const ClusterTree& tree);

} // namespace limn
