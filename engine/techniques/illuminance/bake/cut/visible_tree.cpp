// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/cut/visible_tree.h"

#include <bit>

namespace limn {

VisibleTree::VisibleTree(const SenderOrder& order)
    : m_order(order), m_entry(order.size(), kNone), m_visible((order.size() + 63) / 64) {}

void VisibleTree::build() {
    m_found.clear();
    for (std::size_t word = 0; word < m_visible.size(); ++word) {
        for (std::uint64_t bits = m_visible[word]; bits != 0; bits &= bits - 1) {
            const auto rank = std::uint32_t(word * 64) + std::uint32_t(std::countr_zero(bits));
            m_found.push_back(rank);
        }
        m_visible[word] = 0;
    }
    m_leaves = std::uint32_t(m_found.size());
    const std::uint32_t all = m_leaves > 0 ? 2 * m_leaves - 1 : 0;
    node.resize(all);
    formFactor.resize(all);
    m_child.resize(all - m_leaves);
    m_stack.clear();
    std::uint32_t inner = m_leaves;
    const auto close = [&](std::uint32_t right) {
        const auto [left, join] = m_stack.back();
        m_stack.pop_back();
        node[inner] = join;
        formFactor[inner] = formFactor[left];
        formFactor[inner] += formFactor[right];
        m_child[inner - m_leaves] = {left, right};
        return inner++;
    };
    // Neighbours join at their lowest common ancestor, and an ancestor has the greater number, so a
    // subtree on the stack is complete as soon as the next join lies above it.
    for (std::uint32_t leaf = 0; leaf < m_leaves; ++leaf) {
        const std::uint32_t rank = m_found[leaf];
        node[leaf] = m_order.leafAt(rank);
        formFactor[leaf] = m_added[m_entry[rank]];
        m_entry[rank] = kNone;
        const bool last = leaf + 1 == m_leaves;
        const std::uint32_t join = last ? ~0U : m_order.ancestor(rank, m_found[leaf + 1]);
        std::uint32_t subtree = leaf;
        while (!m_stack.empty() && m_stack.back().join < join)
            subtree = close(subtree);
        if (!last)
            m_stack.push_back({subtree, join});
    }
    m_added.clear();
}

} // namespace limn
