// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/rays/form_factor.h"
#include "engine/techniques/illuminance/bake/senders/sender_order.h"

#include <array>
#include <cstdint>
#include <vector>

namespace limn {

/// The tree spanned by the leaves that a cache sees. Its inner nodes are the ClusterTree's nodes
/// with visible leaves on both sides. Nodes [0, leaves) are leaves from left to right, then inner
/// nodes, children first. One object serves many caches, to save allocations.
class VisibleTree {
public:
    /// `order` must outlive the object.
    explicit VisibleTree(const SenderOrder& order);

    void add(std::uint32_t leaf, const FormFactor& s) {
        const std::uint32_t rank = m_order.rank(leaf);
        std::uint32_t& entry = m_entry[rank];
        if (entry == kNone) {
            entry = std::uint32_t(m_added.size());
            m_visible[rank / 64] |= std::uint64_t(1) << rank % 64;
            m_added.push_back(s);
        } else {
            m_added[entry] += s;
        }
    }
    /// Builds the tree of the leaves that were added since the last call.
    void build();

    std::uint32_t leaves() const { return m_leaves; }
    std::uint32_t size() const { return std::uint32_t(node.size()); }
    /// Child of inner node `i`: side 0 or 1.
    std::uint32_t child(std::uint32_t i, int side) const { return m_child[i - m_leaves][side]; }

    std::vector<std::uint32_t> node; ///< of the ClusterTree
    std::vector<FormFactor> formFactor;

private:
    static constexpr std::uint32_t kNone = ~0U;

    const SenderOrder& m_order;
    std::uint32_t m_leaves = 0;
    std::vector<std::uint32_t> m_entry;   ///< per rank, of m_added; kNone: not visible
    std::vector<std::uint64_t> m_visible; ///< per rank, one bit
    std::vector<FormFactor> m_added;
    std::vector<std::uint32_t> m_found; ///< ranks, from left to right
    std::vector<std::array<std::uint32_t, 2>> m_child;
    struct Open {
        std::uint32_t subtree; ///< a finished one, left of the join
        std::uint32_t join;    ///< node of the ClusterTree where it meets what follows
    };
    std::vector<Open> m_stack;
};

} // namespace limn
