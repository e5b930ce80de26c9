// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/overlay_source.h"

#include <memory>
#include <vector>

namespace limn {

/// The overlay drawn over the picture, and what it is made of.
struct OverlayState {
    OverlayRequest options;
    std::shared_ptr<const OverlaySource> source; ///< null: none yet; a bake while nothing is shown
    std::shared_ptr<const Scene> scene;          ///< scene that `source` was made from
    std::uint32_t maxDepth = 0;                  ///< of options.depth
    std::vector<OverlayLine> picked; ///< describes options.pick; empty: nothing is picked
    OverlayLegend legend;            ///< of the picture on screen
};

} // namespace limn
