// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"

namespace limn {

/// Fills fillBegin … fillWeight. An invalid cache, one without links, becomes the mean of the four
/// nearest valid caches of the lightmap, or of the grid, in the metric |dx|^2 + 16 spacing^2 (1 -
/// n.m), weighted by its inverse. `spacing`: distance between lightmap caches [m]. Returns the
/// number of invalid caches.
std::uint32_t fillInvalid(Caches& caches, float spacing);

} // namespace limn
