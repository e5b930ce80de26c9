// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/gpu/tree_levels.h"

#include <algorithm>
#include <numeric>

namespace limn {

TreeLevels treeLevels(const ClusterTree& tree) {
    const std::uint32_t leaves = tree.leaves();
    std::vector<std::uint32_t> height(tree.size(), 0); // leaves: 0
    TreeLevels levels;
    levels.begin = {0};
    for (std::size_t k = 0; k < tree.left.size(); ++k) {
        const std::uint32_t h = 1 + std::max(height[tree.left[k]], height[tree.right[k]]);
        height[leaves + k] = h;
        levels.begin.resize(std::max<std::size_t>(levels.begin.size(), h + 1), 0);
        ++levels.begin[h];
    }
    std::partial_sum(levels.begin.begin(), levels.begin.end(), levels.begin.begin());
    std::vector<std::uint32_t> next = levels.begin;
    levels.nodes.resize(tree.left.size());
    for (std::uint32_t k = 0; k < tree.left.size(); ++k)
        levels.nodes[next[height[leaves + k] - 1]++] = {leaves + k, tree.left[k], tree.right[k],
                                                        tree.leftWeight[k]};
    return levels;
}

} // namespace limn
