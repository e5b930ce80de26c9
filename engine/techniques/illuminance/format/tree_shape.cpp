// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/format/tree_shape.h"

#include <algorithm>

namespace limn {

TreeShape treeShapeOf(const ClusterTree& tree) {
    TreeShape shape;
    std::vector<std::uint32_t> surfels(tree.size()), depth(tree.size());
    std::fill_n(surfels.begin(), tree.surfels, 1U);
    double balance = 0;
    std::uint32_t joins = 0;
    for (std::size_t k = 0; k < tree.left.size(); ++k) {
        const std::uint32_t l = surfels[tree.left[k]], r = surfels[tree.right[k]];
        surfels[tree.leaves() + k] = l + r;
        if (l > 0 && r > 0) {
            balance += double(std::min(l, r)) / std::max(l, r);
            ++joins;
        }
    }
    for (std::size_t k = tree.left.size(); k-- > 0;)
        for (const std::uint32_t child : {tree.left[k], tree.right[k]})
            depth[child] = depth[tree.leaves() + k] + 1;
    double sum = 0;
    for (std::uint32_t i = 0; i < tree.surfels; ++i) {
        shape.maxDepth = std::max(shape.maxDepth, depth[i]);
        sum += depth[i];
    }
    shape.meanDepth = tree.surfels > 0 ? sum / tree.surfels : 0;
    shape.balance = joins > 0 ? balance / joins : 1;
    return shape;
}

} // namespace limn
