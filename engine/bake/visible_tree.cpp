// SPDX-License-Identifier: MIT
#include "engine/bake/visible_tree.h"

#include <bit>

namespace limn {

VisibleTree::VisibleTree(const SenderOrder& order)
    : m_order(order), m_entry(order.size(), kNone), m_inSight((order.size() + 63) / 64) {}

void VisibleTree::build() {
    m_leaves = std::uint32_t(m_added.size());
    const std::uint32_t all = m_leaves > 0 ? 2 * m_leaves - 1 : 0;
    node.resize(all);
    sight.resize(all);
    m_child.resize(all - m_leaves);
    m_stack.clear();
    // Neighbours join at their lowest common ancestor, and an ancestor has the greater number: so a
    // subtree on the stack is complete as soon as the next join lies above it.
    std::uint32_t leaf = 0, inner = m_leaves, before = 0;
    const auto close = [&](std::uint32_t right) {
        const auto [left, join] = m_stack.back();
        m_stack.pop_back();
        node[inner] = join;
        sight[inner] = sight[left];
        sight[inner] += sight[right];
        m_child[inner - m_leaves] = {left, right};
        return inner++;
    };
    for (std::size_t word = 0; word < m_inSight.size(); ++word) {
        for (std::uint64_t bits = m_inSight[word]; bits != 0; bits &= bits - 1) {
            const auto rank = std::uint32_t(word * 64) + std::uint32_t(std::countr_zero(bits));
            if (leaf > 0) {
                const std::uint32_t join = m_order.ancestor(before, rank);
                std::uint32_t subtree = leaf - 1;
                while (!m_stack.empty() && m_stack.back().join < join)
                    subtree = close(subtree);
                m_stack.push_back({subtree, join});
            }
            node[leaf] = m_order.leafAt(rank);
            sight[leaf] = m_added[m_entry[rank]];
            m_entry[rank] = kNone;
            before = rank;
            ++leaf;
        }
        m_inSight[word] = 0;
    }
    for (std::uint32_t subtree = leaf - 1; !m_stack.empty();)
        subtree = close(subtree);
    m_added.clear();
}

} // namespace limn
