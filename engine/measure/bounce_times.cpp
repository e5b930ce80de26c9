// SPDX-License-Identifier: MIT
#include "engine/measure/bounce_times.h"

#include "engine/lighting/fastest_update.h"

#include <algorithm>
#include <utility>

namespace limn {

BounceTimes timeBounces(Lighting& lighting, const Scene& scene, const TraceScene& trace, int runs,
                        const Progress& progress) {
    std::vector<LightingReport> updates =
        updatesWithMovedLights(lighting, scene, trace, runs, progress);
    if (updates.empty())
        return {};
    BounceTimes times;
    times.steps = std::move(std::ranges::min_element(updates, {}, &LightingReport::totalMs)->steps);
    std::vector<double> ms;
    for (const LightingReport& update : updates)
        ms.push_back(update.totalMs);
    std::ranges::sort(ms);
    times.least = ms.front();
    times.median = ms[ms.size() / 2];
    times.p95 = ms[std::min(ms.size() - 1, ms.size() * 95 / 100)];
    return times;
}

} // namespace limn
