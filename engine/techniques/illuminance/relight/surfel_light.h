// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/direct_irradiance.h"
#include "engine/techniques/illuminance/format/surfel_arrays.h"

namespace limn {

/// Brings the direct light of the surfels up to date, as the mean over each one's light points.
/// Returns true if any irradiance changed.
inline bool updateDirectIrradiance(const Surfels& surfels, const Scene& scene,
                                   const TraceScene& trace, DirectIrradiance& state) {
    return updateDirectIrradiance(surfels.litAt(), surfels.litNormals(), scene, trace, state,
                                  surfels.litAtEach());
}

} // namespace limn
