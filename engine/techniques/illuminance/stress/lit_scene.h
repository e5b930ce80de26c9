// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/techniques/illuminance/bake/bake.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace limn {

/// What a relighter made of a scene: copies of what it tells.
struct RelitState {
    std::vector<glm::vec4> radiosity; ///< as Relighter::radiosity()
    std::vector<glm::vec3> sh;        ///< as Relighter::cacheSh()
    IndirectField field;
    RelightStats stats;
};

/// A scene, baked and lit.
struct LitScene {
    Scene scene;
    std::shared_ptr<const TraceScene> trace;
    std::shared_ptr<const Bake> bake;
    RelitState light;
};

/// Of a fresh relighter after at most `bounces`.
RelitState lightOf(const std::shared_ptr<const Bake>& bake, const Scene& scene,
                   const TraceScene& trace, std::uint32_t bounces, const Progress& progress);

/// Of a relighter as it is now.
RelitState lightOf(const Relighter& relighter, const RelightStats& stats);

/// Bakes and lights by as many bounces as the scene's settings allow. Fails as bake() does.
Result<LitScene> bakeAndLight(const Scene& scene, const Progress& progress);

} // namespace limn
