// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/overlay/overlay.h"

namespace limn {

/// Use of the texels of a lightmap; each array is stored row by row.
struct TexelUse {
    enum class Kind : std::uint8_t {
        Unused,
        Single,  ///< one chart
        Shared,  ///< several charts look it up, but nowhere cover the same point
        Overlap, ///< two triangles cover the same point
    };
    std::vector<Kind> kind;
    std::vector<std::uint32_t> chart; ///< first user, counted through all instances; ~0: none
    std::vector<float> density;       ///< texels per metre, the mean over what uses it; 0: unused
    std::uint32_t charts = 0;         ///< of all instances
};

/// Rasterises every instance's triangles into the atlas, 4 x 4 points a texel.
TexelUse texelUse(const LightmapLayout& layout, const Scene& scene);

/// Builds the overlay of `kind`, which is Charts, Density or Overlap.
OverlayData texelOverlay(const Bake& bake, const Scene& scene, Overlay kind);

} // namespace limn
