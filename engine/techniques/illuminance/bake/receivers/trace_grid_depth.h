// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/grid_depth.h"
#include "engine/techniques/illuminance/bake/transport/gather.h"

#include <cstdint>
#include <vector>

namespace limn {

/// What the rays of the grid's caches tell, as they were traced and before anything is made of
/// them: no ray is traced. A wall is the plane of the surfel that the hit is credited to. Cells
/// follow one another as caches do.
std::vector<std::uint16_t> gridDepths(const Surfels& surfels, const Caches& caches,
                                      const CachePoints& points, const std::vector<RawHit>& hits,
                                      std::uint32_t rays, float reach);

} // namespace limn
