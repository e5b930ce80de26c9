// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/lpv/propagation.h"

#include <cstdint>
#include <vector>

namespace limn {

/// arrivalRounds() of a cell that stays dark.
inline constexpr std::uint32_t kNeverLit = ~0U;
/// Share of a cell's final light that counts as arrived.
inline constexpr float kArrivedShare = 0.01f;

/// Per cell, in the order of a Lattice, the round after which its flux is at least kArrivedShare of
/// that after all rounds; 0: light is injected there. Propagates as propagate() does, twice.
std::vector<std::uint32_t> arrivalRounds(const CellLight& injected, const FaceBlockers* blockers,
                                         std::uint32_t rounds);

} // namespace limn
