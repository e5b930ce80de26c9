// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/texel_side.h"
#include "engine/lightmap/texel_sides.h"

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// The snap that keeps most of the bilinear weight at `f`, among snaps that read only those of the
/// four texels that are on the same side as `from`; kSnaps if there is none. `texel` are indices
/// into `side`, ~0 outside the chart.
std::uint32_t chooseSnap(const SideFinder& sides, const std::vector<TexelSide>& side,
                         const std::array<std::uint32_t, 4>& texel, const LiftedPoint& from,
                         glm::vec2 f);

/// LightmapLayout::snaps of an atlas' lookups, from the sides of its texels. `placed` as for
/// findTexelSides(). The result must not be used when cancelled.
std::vector<std::uint32_t> findSnaps(const SideFinder& sides, const std::vector<AtlasTexel>& texels,
                                     const std::vector<TexelSide>& side,
                                     const std::vector<PlacedTriangle>& placed,
                                     const Progress& progress);

} // namespace limn
