// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/format/tree_rules.h"

namespace limn {

bool isTree(const std::vector<std::uint32_t>& left, const std::vector<std::uint32_t>& right,
            std::uint32_t leaves) {
    if (leaves == 0 || left.size() != leaves - 1 || right.size() != left.size())
        return false;
    std::vector<bool> hasParent(leaves + left.size());
    for (std::size_t k = 0; k < left.size(); ++k)
        for (const std::uint32_t child : {left[k], right[k]}) {
            if (child >= leaves + k || hasParent[child])
                return false;
            hasParent[child] = true;
        }
    return true; // 2 (leaves - 1) children: all nodes but the last have a parent
}

} // namespace limn
