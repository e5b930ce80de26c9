// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/final_lightmap/lit_texels.h"
#include "engine/lightmap/texel_side.h"

#include <vector>

namespace limn {

/// Finds LitTexels::links: neighbours of one chart of the scene before it was cut, with no wall
/// between them. Where a chart was cut, the texels of one piece are linked to those of the next.
/// `side` is per texel. Incomplete when cancelled.
std::vector<SharingLinks> findSharing(const SideFinder& sides, const CutScene& cut,
                                      const LitTexels& lit, const std::vector<TexelSide>& side,
                                      const Progress& progress);

} // namespace limn
