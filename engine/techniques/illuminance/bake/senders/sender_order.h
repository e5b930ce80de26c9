// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"

#include <cstdint>
#include <vector>

namespace limn {

/// The leaves of a ClusterTree from left to right, and where neighbours in that row part: enough to
/// join any few of them to the small tree that they span, in time that depends on them alone.
class SenderOrder {
public:
    /// O(n log n) in time and memory; 17 MiB for 128 k leaves.
    explicit SenderOrder(const ClusterTree& tree);

    std::uint32_t size() const { return std::uint32_t(m_leaf.size()); } ///< leaves

    /// Place of a leaf in the row.
    std::uint32_t rank(std::uint32_t leaf) const { return m_rank[leaf]; }
    std::uint32_t leafAt(std::uint32_t rank) const { return m_leaf[rank]; }

    /// The lowest node above both leaves, by rank. Precondition: first < second.
    std::uint32_t ancestor(std::uint32_t first, std::uint32_t second) const;

private:
    std::vector<std::uint32_t> m_rank, m_leaf;
    /// m_parting[k][i]: the highest of the 2^k nodes at which leaf i and i+1, i+1 and i+2, … part.
    /// Of two nodes of which one lies above the other, that one has the greater number.
    std::vector<std::vector<std::uint32_t>> m_parting;
};

} // namespace limn
