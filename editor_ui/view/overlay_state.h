// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/precomputed.h"

#include <memory>
#include <vector>

namespace limn {

/// The overlay drawn over the picture, and the bake it shows.
struct OverlayState {
    OverlayRequest options;
    std::shared_ptr<const Precomputed> bake; ///< null: none yet
    std::shared_ptr<const Scene> scene;      ///< scene that was baked
    std::uint32_t maxDepth = 0;              ///< of options.depth
    std::vector<OverlayLine> picked;         ///< describes options.pick; empty: nothing is picked
    OverlayLegend legend;                    ///< of the picture on screen
};

} // namespace limn
