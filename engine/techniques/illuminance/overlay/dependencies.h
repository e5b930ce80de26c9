// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/overlay/overlay.h"

#include <cstdint>
#include <vector>

namespace limn {

/// What sends the bounced light of a whole object. Direct light of lamps is not part of it.
struct Dependencies {
    std::uint32_t instance = ~0u; ///< that is lit; ~0: the surroundings of a cell of the grid
    /// Per instance of the scene: illuminance by the light that it reflects and emits [lux].
    std::vector<double> sent;
    double sky = 0;   ///< the same of the sky [lux]
    double total = 0; ///< sum of both [lux]
};

/// Computes what lights the object to which a cache belongs: the mean over its lightmap's texels,
/// weighted by the area that they stand for; of the one cell for a cell of the grid. Caches without
/// links count as what fills them. `radiosity` is LitBake::radiosity. Precondition: `cache` < the
/// bake's number of caches.
Dependencies dependenciesOf(const Bake& bake, const Scene& scene,
                            const std::vector<glm::vec4>& radiosity, std::uint32_t cache);

/// Surfels in the colour of their object's share of the light of the object to which
/// `options.cache` belongs. Precondition: `lit` fits the bake.
OverlayData dependencyOverlay(const Bake& bake, const Scene& scene, const OverlayOptions& options,
                              const LitBake& lit);

} // namespace limn
