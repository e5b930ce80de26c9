// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/sender_order.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace limn {

SenderOrder::SenderOrder(const ClusterTree& tree) : m_rank(tree.leaves()) {
    // Depth-first traversal with a stack. An inner node, visited between its halves, is the lowest
    // common ancestor of the leaves on either side.
    std::vector<std::uint32_t> parting;
    struct Visit {
        std::uint32_t node;
        bool between;
    };
    std::vector<Visit> stack = {{tree.size() - 1, false}};
    while (!stack.empty()) {
        const Visit v = stack.back();
        stack.pop_back();
        if (v.between) {
            parting.push_back(v.node);
        } else if (v.node < tree.leaves()) {
            m_rank[v.node] = std::uint32_t(m_leaf.size());
            m_leaf.push_back(v.node);
        } else {
            const std::uint32_t inner = v.node - tree.leaves();
            stack.push_back({tree.right[inner], false});
            stack.push_back({v.node, true});
            stack.push_back({tree.left[inner], false});
        }
    }
    m_parting.push_back(std::move(parting));
    for (std::size_t half = 1; 2 * half <= m_parting[0].size(); half *= 2) {
        const std::vector<std::uint32_t>& last = m_parting.back();
        std::vector<std::uint32_t> next(m_parting[0].size() + 1 - 2 * half);
        for (std::size_t i = 0; i < next.size(); ++i)
            next[i] = std::max(last[i], last[i + half]);
        m_parting.push_back(std::move(next));
    }
}

std::uint32_t SenderOrder::ancestor(std::uint32_t first, std::uint32_t second) const {
    assert(first < second && second < m_leaf.size());
    const std::uint32_t length = second - first;
    const auto level = std::size_t(std::bit_width(length) - 1);
    return std::max(m_parting[level][first], m_parting[level][second - (1U << level)]);
}

} // namespace limn
