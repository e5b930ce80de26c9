// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"

namespace limn {

/// Fills fillBegin … fillWeight: an invalid cache, one without links, becomes the mean of the four
/// valid ones of the lightmap, or of the grid, that are nearest in |dx|^2 + 16 spacing^2 (1 - n.m),
/// weighted by the inverse of that. `spacing`: of lightmap caches [m]. Returns the number of
/// invalid caches.
std::uint32_t fillInvalid(Caches& caches, float spacing);

} // namespace limn
