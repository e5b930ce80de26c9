// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/grid_depth.h"
#include "engine/techniques/illuminance/bake/rays/gather.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Computes the grid's depth maps (field/grid_depth.h) from the raw hits of the rays of its caches,
/// without tracing further rays. A wall is the plane of the surfel that the hit is credited to.
/// Cells are in the order of the caches.
std::vector<std::uint16_t> gridDepths(const Surfels& surfels, const Caches& caches,
                                      const CachePoints& points, const std::vector<RawHit>& hits,
                                      std::uint32_t rays, float reach);

} // namespace limn
