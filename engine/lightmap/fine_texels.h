// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/density.h"
#include "engine/lightmap/fine_blocks.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Triangles of the charts whose density varies (BakeDensity::varied), on each of their sides.
std::vector<PlacedTriangle> variedTriangles(const Scene& scene, const BakeDensity& density,
                                            const LightmapLayout& layout);

/// Traces rays from all lookups of the charts whose density varies (BakeDensity::varied) and
/// refines those that need more than their texels, nearest surroundings first, by up to `maxTexels`
/// texels. A ground 200 m wide thus gets texels of centimetres inside the house that stands on it.
/// The result must not be used when cancelled.
FineLookups findFineLookups(const TraceScene& trace, const Atlas& atlas, const BakeDensity& density,
                            std::uint32_t maxTexels, const Progress& progress);

} // namespace limn
