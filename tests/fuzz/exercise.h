// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "engine/trace/trace_scene.h"
#include "tests/fuzz/target.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace limn {

inline bool allFinite(const std::vector<glm::vec4>& values) {
    return std::ranges::all_of(values, [](const glm::vec4& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    });
}

/// Two bounces of the scene's light. Whatever was accepted must light to finite numbers.
inline void relight(const Scene& scene, const TraceScene& trace, Bake made) {
    Relighter relighter(std::make_shared<const Bake>(std::move(made)));
    relighter.relight(scene, trace, 2);
    require(allFinite(relighter.field().lightmap), "the light of a lightmap is finite");
    require(allFinite(relighter.field().grid), "the light of a grid is finite");
}

/// Nearly the least counts a bake can have, so that the fuzzer tries many.
inline BakeSettings smallBake() {
    BakeSettings settings;
    settings.surfels = 64;
    settings.links = 4;
    settings.rays = 16;
    settings.lightmapCaches = 16;
    settings.grid = {1, 1, 1};
    return settings;
}

/// Uses an accepted scene as the program would: its materials, its camera, a bake and its light.
/// Scenes of many triangles are not baked, since their bakes rightly take long.
inline void exercise(const Scene& scene) {
    constexpr std::size_t kMaxTriangles = 2000;
    std::size_t triangles = 0;
    for (const Instance& instance : scene.instances) {
        const auto count = std::uint32_t(scene.meshOf(instance).triangleCount());
        triangles += count;
        for (std::uint32_t t = 0; t < std::min(count, 8U); ++t) {
            const SurfaceMaterial m = surfaceMaterial(scene, instance, t, 0.3f, 0.3f);
            require(m.albedo.x >= 0 && m.albedo.x <= 0.99f, "an albedo is in [0, 0.99]");
            require(std::isfinite(m.emission.x), "emission is finite");
        }
        if (triangles > kMaxTriangles)
            return;
    }
    chooseCamera(scene, std::optional<std::string>());
    const TraceScene trace(scene);
    const BakeSettings settings = smallBake();
    if (Result<Bake> made = bake(trace, {}, nullptr, &settings, kFuzzMemory))
        relight(scene, trace, std::move(*made));
}

} // namespace limn
