// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/relight/caches/light_links.h"

#include <span>

#include <glm/vec3.hpp>

namespace limn {

/// The reverse of lightCones() for one cache: adds to each linked node's weight the sum over
/// coefficients of the cache's weight times what a radiosity of 1 at the node adds to that
/// coefficient. Links of LinkStorage::Rtp before ends[cache] are read. `weights`: bands^2 of the
/// cache, bands in [2, 3]. `nodes`: one per node of the tree.
void weighCones(const Caches& caches, LinkEnds ends, std::uint32_t cache,
                std::span<const glm::vec3> weights, std::span<glm::vec3> nodes);

} // namespace limn
