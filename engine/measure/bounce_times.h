// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lighting/lighting.h"

#include <vector>

namespace limn {

/// Times of updates of one bounce, each with all lights moved [ms].
struct BounceTimes {
    /// Other work on the machine only ever adds time, so that this is what runs of the program
    /// agree on best.
    double least = 0;
    double median = 0, p95 = 0;
    std::vector<LightingStep> steps; ///< of the update that took least
};

/// Times `runs` updates after one that does not count. `lighting` lights `scene`, to which `trace`
/// belongs, and is left with its lights moved. All 0 when cancelled.
BounceTimes timeBounces(Lighting& lighting, const Scene& scene, const TraceScene& trace, int runs,
                        const Progress& progress = {});

} // namespace limn
