// SPDX-License-Identifier: MIT
#include "engine/bake/visible_tree.h"

#include <algorithm>

namespace limn {

VisibleTree::VisibleTree(const SenderOrder& order) : m_order(order) {}

void VisibleTree::clear() {
    node.clear();
    sight.clear();
    m_seen.clear();
    m_added.clear();
    m_child.clear();
    m_leaves = 0;
}

void VisibleTree::add(std::uint32_t leaf, const Sight& s) {
    m_seen.push_back(std::uint64_t(m_order.rank(leaf)) << 32 | m_added.size());
    m_added.push_back(s);
}

void VisibleTree::build() {
    std::sort(m_seen.begin(), m_seen.end()); // by rank, then in the order of the rays
    std::uint32_t rank = ~0U;
    for (const std::uint64_t seen : m_seen) {
        if (const auto next = std::uint32_t(seen >> 32); next != rank) {
            rank = next;
            node.push_back(m_order.leafAt(rank));
            sight.emplace_back();
        }
        sight.back() += m_added[std::uint32_t(seen)];
    }
    m_leaves = std::uint32_t(node.size());
    // Neighbours join at their lowest common ancestor, and an ancestor has the greater number: so a
    // subtree on the stack is complete as soon as the next join lies above it.
    m_stack.clear();
    const auto close = [&](std::uint32_t right) {
        const auto [left, join] = m_stack.back();
        m_stack.pop_back();
        node.push_back(join);
        Sight sum = sight[left];
        sum += sight[right];
        sight.push_back(sum);
        m_child.push_back({left, right});
        return size() - 1;
    };
    for (std::uint32_t leaf = 0; leaf < m_leaves; ++leaf) {
        std::uint32_t subtree = leaf;
        const std::uint32_t join =
            leaf + 1 < m_leaves
                ? m_order.ancestor(m_order.rank(node[leaf]), m_order.rank(node[leaf + 1]))
                : ~0U;
        while (!m_stack.empty() && m_stack.back().join < join)
            subtree = close(subtree);
        if (join != ~0U)
            m_stack.push_back({subtree, join});
    }
}

} // namespace limn
