// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/scene.h"

#include <glm/vec3.hpp>

namespace limn {

/// Number of grid cells per axis: settings.grid; where that is 0 and some instance has no lightmap,
/// cubes of about 1/12 of the longest side, between 2 and 32 per axis; otherwise 0.
glm::uvec3 chooseGridSize(const Scene& scene, const LightmapLayout& layout,
                          const BakeSettings& settings);

/// Bounds of the grid: those of the static scene, widened where it is flat. A dynamic object beyond
/// them reads the nearest cells.
Bounds gridBoundsOf(const Scene& scene);

/// Whether some instance of `scene` is lit from the grid: dynamic, or without lightmap.
bool needsGrid(const Scene& scene, const LightmapLayout& layout);

} // namespace limn
