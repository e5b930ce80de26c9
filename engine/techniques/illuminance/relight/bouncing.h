// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/convergence.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/relight/caches/light_links.h"

#include <algorithm>
#include <vector>

namespace limn {

/// Per surfel, its share of everything that caches see. The shares sum to 1 with the sky's.
std::vector<float> seenShares(const ClusterTree& tree);

/// The bands of the final light that receivers see, where `lit` of the bake's bands are lit.
inline LightBands finalBands(const BakeSettings& settings, int lit) {
    return {lit, std::min(int(chromaBandsOf(settings)), lit)};
}

/// The bands that surfels read. A surface gets half of its irradiance from the second band, so
/// without colour in it every bounce would make the light greyer.
inline LightBands bounceBands(const BakeSettings& settings, int lit) {
    const LightBands last = finalBands(settings, lit);
    return {last.luma, std::max(last.chroma, 2)};
}

} // namespace limn
