// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace limn {

/// Copies of a relighter's results for a scene.
struct RelitState {
    std::vector<glm::vec4> radiosity; ///< as Relighter::radiosity()
    std::vector<glm::vec3> sh;        ///< as Relighter::cacheSh()
    IndirectField field;
    RelightStats stats;
};

/// A scene with its bake and its light.
struct LitScene {
    Scene scene;
    std::shared_ptr<const TraceScene> trace;
    std::shared_ptr<const Bake> bake;
    RelitState light;
};

/// Results of a fresh relighter after at most `bounces` bounces.
RelitState lightOf(const std::shared_ptr<const Bake>& bake, const Scene& scene,
                   const TraceScene& trace, std::uint32_t bounces, const Progress& progress);

/// Results of a relighter in its present state.
RelitState lightOf(const Relighter& relighter, const RelightStats& stats);

/// Bakes a scene and lights it with at most as many bounces as its settings allow. Fails as bake()
/// does.
Result<LitScene> bakeAndLight(const Scene& scene, const Progress& progress);

} // namespace limn
