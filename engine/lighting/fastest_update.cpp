// SPDX-License-Identifier: MIT
#include "engine/lighting/fastest_update.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

std::vector<Light> movedLights(std::vector<Light> lights, int k) {
    const float a = 0.01f * float(k);
    const glm::vec3 d(std::sin(a), 0, std::cos(a) - 1);
    for (Light& light : lights) {
        light.position += d * 0.1f;
        light.direction = glm::normalize(light.direction + d * 0.1f);
    }
    return lights;
}

Scene withMovedLights(const Scene& scene, int k) {
    Scene moved = scene;
    moved.lights = movedLights(scene.lights, k);
    if (moved.lights.empty()) { // every kind of sky reads one of these
        moved.sky.radiance += 0.01f * float(k);
        moved.sky.strength += 0.01f * float(k);
    }
    return moved;
}

std::vector<LightingReport> updatesWithMovedLights(Lighting& lighting, const Scene& scene,
                                                   const TraceScene& trace, int runs,
                                                   const Progress& progress) {
    std::vector<LightingReport> updates;
    for (int k = 0; k <= runs; ++k) {
        const Scene moved = withMovedLights(scene, k);
        LightingReport update =
            lighting.update({.scene = moved, .trace = &trace, .bounces = 1}, progress);
        if (progress.cancelled())
            return {};
        if (k > 0)
            updates.push_back(std::move(update));
    }
    return updates;
}

LightingReport fastestUpdate(Lighting& lighting, const Scene& scene, const TraceScene& trace,
                             int runs, const Progress& progress) {
    std::vector<LightingReport> updates =
        updatesWithMovedLights(lighting, scene, trace, runs, progress);
    const auto best = std::ranges::min_element(updates, {}, &LightingReport::totalMs);
    return best == updates.end() ? LightingReport{} : std::move(*best);
}

} // namespace limn
