// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/atlas.h"
#include "engine/core/progress.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// The atlas' texels, places for points given to those of a texel's points that are open, in
/// proportion: the share of a few directions in which nothing lies within a texel's width, nor the
/// back of a one-sided surface anywhere. So much of a point is seen from further off than the texel
/// is wide: folds and corners count for little in it, as they do in a picture, and what lies in a
/// solid for nothing. A texel without any open point keeps all. `rays` grows by the rays traced. Of
/// no use when cancelled.
std::vector<AtlasTexel> withOpenPoints(const TraceScene& trace, const Progress& progress,
                                       const Atlas& atlas, std::uint64_t& rays);

} // namespace limn
