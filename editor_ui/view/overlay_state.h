// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/overlay/link_cut.h"
#include "engine/techniques/illuminance/overlay/overlay.h"

#include <memory>
#include <optional>

namespace limn {

/// The overlay drawn over the picture, and the bake it shows.
struct OverlayState {
    OverlayOptions options;
    std::shared_ptr<const Bake> bake;   ///< null: none yet
    std::shared_ptr<const Scene> scene; ///< scene that was baked
    std::uint32_t treeDepth = 0;        ///< of the bake's tree
    std::optional<LinkCut> cut;         ///< of options.cache
    OverlayLegend legend;               ///< of the picture on screen
};

} // namespace limn
