// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/light_snapshot.h"
#include "engine/lighting/overlay_source.h"
#include "engine/scene/camera.h"
#include "engine/scene/document.h"

#include <memory>
#include <string>
#include <vector>

namespace limn {

/// What an overlay tells about the surface under the mouse, and what that was read of.
struct OverlayHover {
    glm::vec2 mouse{0}; ///< [px]
    Camera camera;
    OverlayRequest options;
    std::shared_ptr<const OverlaySource> source;
    std::shared_ptr<const LightSnapshot> light;
    std::string text; ///< in lines; empty: nothing is said
};

/// The overlay drawn over the picture, and what it is made of.
struct OverlayState {
    OverlayRequest options;
    std::shared_ptr<const OverlaySource> source; ///< null: none yet; a bake while nothing is shown
    std::shared_ptr<const Scene> scene;          ///< scene that `source` was made from
    std::shared_ptr<const LightSnapshot> light;  ///< of `source`; null: not at hand
    std::uint32_t maxDepth = 0;                  ///< of options.depth
    std::vector<OverlayLine> picked; ///< describes options.pick; empty: nothing is picked
    ObjectId followed = 0;           ///< object last picked by followSelection()
    OverlayHover hover;
    OverlayLegend legend; ///< of the picture on screen
};

} // namespace limn
