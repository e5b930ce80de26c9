// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/surfels.h"

namespace limn {

/// Number of sky cells: a sender for each, of equal solid angle.
inline constexpr std::uint32_t kSkyCells = 256;

/// The cell of the sky in direction `d` (unit): equal-area bands of height by sectors about +Y.
std::uint32_t skyCellOf(glm::vec3 d);

/// Trees per mesh, built once in object space and used by each instance, a tree over the sky cells,
/// and one over those. Each splits its senders at the median of the widest of six coordinates:
/// position / extent and sqrt(C_n / 2) normal, in which squared distance is the paper's metric
/// without its term for balance, which the median gives.
ClusterTree buildClusterTree(const Scene& scene, const SurfelSet& set);

} // namespace limn
