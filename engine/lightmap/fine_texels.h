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

/// Lookups between four texels of an atlas that read a block of finer texels instead. A block has
/// (kFineCells + 1)^2 texels, stored below the atlas; its corners coincide with the four texels.
/// Lookups inside a block may in turn read even finer blocks.
struct FineLookups {
    std::vector<std::vector<std::uint32_t>> places; ///< per level, ascending; y * width + x
    std::uint64_t rays = 0;                         ///< number of rays traced to find them

    /// Maximum number of texels in their blocks.
    std::uint64_t texels() const;
};

/// Traces rays from all lookups of the charts whose density varies (BakeDensity::varied) and
/// refines those that need more than their texels, nearest surroundings first, up to `most` texels.
/// A ground 200 m wide thus gets texels of centimetres inside the house that stands on it. The
/// result must not be used when cancelled.
FineLookups findFineLookups(const TraceScene& trace, const Atlas& atlas, const BakeDensity& density,
                            std::uint32_t most, const Progress& progress);

/// Adds the fine texels: grows the atlas, redirects the lookups to their blocks
/// (LightmapLayout::snaps) and returns how triangles lie in these blocks.
std::vector<PlacedTriangle> addFineTexels(const Scene& scene, const BakeDensity& density,
                                          const FineLookups& lookups, Atlas& atlas);

} // namespace limn
