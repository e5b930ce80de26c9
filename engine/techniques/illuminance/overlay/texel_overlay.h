// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/overlay/overlay.h"

namespace limn {

/// How the texels of a lightmap are used; each array row by row.
struct TexelUse {
    enum class Kind : std::uint8_t {
        Unused,
        Single,  ///< one chart
        Shared,  ///< several charts look it up, but nowhere cover the same point
        Overlap, ///< two triangles cover the same point
    };
    std::vector<Kind> kind;
    std::vector<std::uint32_t>
        chart; ///< the first one to use it, counted through all instances; ~0: none
    std::vector<float> density; ///< texels per metre, the mean of what uses it; 0: none
    std::uint32_t charts = 0;   ///< of all instances
};

/// Rasterises every instance's triangles into the atlas, 4 x 4 points a texel.
TexelUse texelUse(const LightmapLayout& layout, const Scene& scene);

/// Charts, Density or Overlap.
OverlayData texelOverlay(const Bake& bake, const Scene& scene, Overlay kind);

} // namespace limn
