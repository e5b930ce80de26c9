// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace limn {

/// The inner nodes of a tree over `leaves` leaves: every node but the last is a child of exactly
/// one, which comes after it. Children of inner node k are numbers < leaves + k.
bool isTree(const std::vector<std::uint32_t>& left, const std::vector<std::uint32_t>& right,
            std::uint32_t leaves);

} // namespace limn
