// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Number of sky cells. Each is a sender, and all have equal solid angle.
inline constexpr std::uint32_t kSkyCells = 256;

/// Sky cell in direction `d` (unit). Cells are sectors about +Y of equal-area bands of height.
std::uint32_t skyCellOf(glm::vec3 d);

/// Unit direction of the middle of a cell. `cell` < kSkyCells.
glm::vec3 skyCellDirection(std::uint32_t cell);

/// Per node, true where all leaves below it are sky cells. Links to such nodes bring no light while
/// the sky is black.
std::vector<bool> skyNodes(const ClusterTree& tree);

} // namespace limn
