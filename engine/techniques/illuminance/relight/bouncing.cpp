// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/bouncing.h"

namespace limn {

std::vector<float> seenShares(const ClusterTree& tree) {
    std::vector<float> share(tree.size(), 0);
    if (share.empty())
        return share;
    share.back() = 1; // the root
    for (std::size_t k = tree.left.size(); k-- > 0;) {
        const float whole = share[tree.leaves() + k], left = whole * tree.leftWeight[k];
        share[tree.left[k]] = left;
        share[tree.right[k]] = whole - left;
    }
    share.resize(tree.surfels);
    return share;
}

} // namespace limn
