// SPDX-License-Identifier: MIT
#include "app/editor/measure_relight.h"

#include "app/bench/moving_lights.h"

#include <algorithm>
#include <array>

namespace limn {

namespace {

constexpr int kRuns = 3;

// The sky changes too: there may be no light.
Scene sceneAt(const Scene& scene, int k) {
    Scene moved = scene;
    moved.lights = movedLights(scene.lights, k);
    if (moved.lights.empty()) { // every kind of sky reads one of these
        moved.sky.radiance += 0.01f * float(k);
        moved.sky.strength += 0.01f * float(k);
    }
    return moved;
}

template <class Relight>
double medianMs(const Scene& scene, const Relight& relight) {
    std::array<double, kRuns> ms{};
    relight(sceneAt(scene, 0)); // lights the materials too
    for (int k = 0; k < kRuns; ++k)
        ms[std::size_t(k)] = relight(sceneAt(scene, k + 1)).totalMs;
    std::sort(ms.begin(), ms.end());
    return ms[kRuns / 2];
}

} // namespace

RelightTimes measureRelight(Viewport& viewport, Lighting& onDevice, Lighting& onCpu,
                            const Scene& scene, const TraceScene& trace) {
    RelightTimes times;
    times.cpuMs = medianMs(scene, [&](const Scene& s) {
        return onCpu.update({.scene = s, .trace = &trace, .bounces = 1}, {});
    });
    times.gpuMs = medianMs(scene, [&](const Scene& s) {
        viewport.setLighting(s);
        return onDevice.update({.scene = s, .bounces = 1}, {});
    });
    return times;
}

} // namespace limn
