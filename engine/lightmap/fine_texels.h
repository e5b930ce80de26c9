// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/atlas.h"
#include "engine/lightmap/density.h"
#include "engine/lightmap/texel_sides.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Lookups between four texels of an atlas that read a block of finer texels instead: (kFineCells +
/// 1)^2 of them, below the atlas, so that the four corners lie in the block's. Their own lookups
/// may read yet finer ones.
struct FineLookups {
    std::vector<std::vector<std::uint32_t>> places; ///< per level, ascending; y * width + x
    std::uint64_t rays = 0;                         ///< traced to find them

    /// Of their blocks, at most.
    std::uint64_t texels() const;
};

/// Looks round from all lookups of the charts whose density varies (BakeDensity::varied), and where
/// one deserves more than its texels, adds finer ones; at most `most` texels, where what is seen is
/// nearest. So a ground 200 m wide has texels of centimetres in the house that stands on it. Of no
/// use when cancelled.
FineLookups findFineLookups(const TraceScene& trace, const Atlas& atlas, const BakeDensity& density,
                            std::uint32_t most, const Progress& progress);

/// Adds the texels: grows the atlas, leads the lookups to their blocks (LightmapLayout::snaps), and
/// returns how triangles lie in these.
std::vector<PlacedTriangle> addFineTexels(const Scene& scene, const BakeDensity& density,
                                          const FineLookups& lookups, Atlas& atlas);

} // namespace limn
