// SPDX-License-Identifier: MIT
#include "engine/measure/bounce_times.h"

#include "engine/lighting/fastest_update.h"

#include <algorithm>
#include <utility>

namespace limn {

BounceTimes timeBounces(Lighting& lighting, const Scene& scene, const TraceScene& trace, int runs,
                        const Progress& progress) {
    BounceTimes times;
    std::vector<double> ms;
    for (int k = 0; k <= runs; ++k) {
        const Scene moved = withMovedLights(scene, k);
        LightingReport update =
            lighting.update({.scene = moved, .trace = &trace, .bounces = 1}, progress);
        if (progress.cancelled())
            return {};
        if (k == 0)
            continue;
        if (ms.empty() || update.totalMs < *std::ranges::min_element(ms))
            times.steps = std::move(update.steps);
        ms.push_back(update.totalMs);
    }
    if (ms.empty())
        return {};
    std::ranges::sort(ms);
    times.least = ms.front();
    times.median = ms[ms.size() / 2];
    times.p95 = ms[std::min(ms.size() - 1, ms.size() * 95 / 100)];
    return times;
}

} // namespace limn
