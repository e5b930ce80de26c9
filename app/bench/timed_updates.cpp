// SPDX-License-Identifier: MIT
#include "app/bench/timed_updates.h"

#include "app/bench/moving_lights.h"
#include "app/bench/smooth_motion.h"

#include "engine/lighting/fastest_update.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace limn {

namespace {

/// The scene with its lights moved as in run k, or, where it has none, with a brighter sky and
/// brighter emissive surfaces.
Scene withOtherLight(const Scene& scene, int k) {
    Scene other = withMovedLights(scene, k);
    if (scene.lights.empty())
        for (Material& material : other.materials)
            material.emission *= 1 + 0.01f * float(k);
    return other;
}

/// The view with its camera turned about the vertical [rad].
Viewpoint turnedView(Viewpoint view, float angle) {
    view.camera.target = view.camera.eye + turned(view.camera.target - view.camera.eye, angle);
    return view;
}

/// Median over runs, which count from 1, of what measure(run) returns [ms].
template <class Measure>
double median(const UpdateRuns& runs, const Measure& measure) {
    std::vector<double> ms;
    double sum = 0;
    for (int k = 1; k <= runs.maxRuns && (k == 1 || sum < runs.enoughMs); ++k)
        sum += ms.emplace_back(measure(k));
    std::ranges::sort(ms);
    return ms[ms.size() / 2];
}

} // namespace

UpdateTimes timeUpdates(Lighting& lighting, const Scene& scene, const TraceScene& trace,
                        const Viewpoint& view, const UpdateRuns& runs) {
    const auto lightUp = [&](const LightingInput& input) {
        return lighting.update(input, {}).totalMs;
    };
    const auto update = [&](const Scene& changed, const TraceScene& changedTrace) {
        return lightUp({.scene = changed,
                        .trace = &changedTrace,
                        .bounces = changed.relight.maxBounces,
                        .view = viewForAll(lighting, view),
                        .reflections = true});
    };
    const auto medianOf = [&](const auto& change) {
        const double ms = median(runs, [&](int k) {
            Scene changed = scene;
            change(changed, k);
            return update(changed, trace);
        });
        update(scene, trace);
        return ms;
    };
    UpdateTimes times;
    times.light = medianOf([](Scene& s, int k) { s = withOtherLight(s, k); });
    if (!scene.lights.empty())
        times.color = medianOf([](Scene& s, int k) {
            for (Light& light : s.lights)
                light.color *= 1 + 0.01f * float(k);
        });
    times.material = medianOf([](Scene& s, int k) {
        if (!s.materials.empty())
            s.materials[0].baseColor *= glm::vec4(glm::vec3(1 - 0.01f * float(k)), 1);
    });
    if (std::ranges::any_of(scene.instances, [](const Instance& i) { return i.dynamic; })) {
        times.object = median(runs, [&](int k) {
            Scene changed = scene;
            moveObjects(changed, scene, k);
            const TraceScene moved(changed, trace);
            return update(changed, moved);
        });
        update(scene, trace);
    }
    const Viewpoint aside = turnedView(view, view.camera.fovY / 3);
    times.camera = median(runs, [&](int k) {
        const Scene changed = withOtherLight(scene, k);
        const auto look = [&](const Viewpoint& from, std::uint32_t bounces) {
            return lightUp({.scene = changed,
                            .trace = &trace,
                            .bounces = bounces,
                            .view = &from,
                            .reflections = true});
        };
        look(view, changed.relight.maxBounces);
        return look(aside, 0);
    });
    update(scene, trace);
    return times;
}

} // namespace limn
