// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/atlas.h"
#include "engine/bake/bake.h"

namespace limn {

/// The caches of an atlas' texels, then those of the grid; only kind, position, normal and texel
/// are filled.
Caches placeCaches(const Scene& scene, const Atlas& atlas, glm::uvec3 gridSize,
                   const Bounds& gridBounds);

/// Cells of the grid: settings.grid; or, where that is 0 and some instance has no lightmap, cubes
/// of about 1/12 of the longest side, at most 32 a side; or none.
glm::uvec3 chooseGridSize(const Scene& scene, const LightmapLayout& layout,
                          const BakeSettings& settings);

/// The scene's bounds, never empty in any direction.
Bounds gridBoundsOf(const Scene& scene);

/// Gives every surfel its four caches: the bilinear lookup at its place in the lightmap.
void connectSurfels(const Scene& scene, const LightmapLayout& layout, const Caches& caches,
                    Surfels& surfels);

} // namespace limn
