// SPDX-License-Identifier: MIT
#include "app/editor/measure_relight.h"

#include "engine/lighting/fastest_update.h"

#include <algorithm>
#include <array>

namespace limn {

namespace {

constexpr int kRuns = 3;

/// None if an update was skipped.
template <class Relight>
std::optional<double> medianMs(const Scene& scene, const Relight& relight) {
    std::array<double, kRuns> ms{};
    relight(withMovedLights(scene, 0)); // lights the materials too
    for (int k = 0; k < kRuns; ++k) {
        const LightingReport report = relight(withMovedLights(scene, k + 1));
        if (report.skipped)
            return {};
        ms[std::size_t(k)] = report.totalMs;
    }
    std::sort(ms.begin(), ms.end());
    return ms[kRuns / 2];
}

} // namespace

std::optional<RelightTimes> measureRelight(Viewport& viewport, Lighting& onDevice, Lighting& onCpu,
                                           const Scene& scene, const TraceScene& trace) {
    const auto cpuMs = medianMs(scene, [&](const Scene& s) {
        return onCpu.update({.scene = s, .trace = &trace, .bounces = 1}, {});
    });
    const auto gpuMs = medianMs(scene, [&](const Scene& s) {
        viewport.setLighting(s);
        return onDevice.update({.scene = s, .bounces = 1}, {});
    });
    if (!cpuMs || !gpuMs)
        return {};
    return RelightTimes{.cpuMs = *cpuMs, .gpuMs = *gpuMs};
}

} // namespace limn
