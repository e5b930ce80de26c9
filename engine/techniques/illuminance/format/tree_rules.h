// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace limn {

/// Whether these are the inner nodes of a tree over `leaves` leaves: every node but the last is a
/// child of exactly one node, which comes after it, and children of inner node k are < leaves + k.
bool isTree(const std::vector<std::uint32_t>& left, const std::vector<std::uint32_t>& right,
            std::uint32_t leaves);

} // namespace limn
