// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/lighting/lighting.h"
#include "engine/lightmap/lightmap_layout.h"

#include <memory>
#include <string>

namespace limn {

struct Bake;

/// A scene lit to convergence on the CPU by the technique that its document names.
struct LitScene {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const TraceScene> trace;
    std::shared_ptr<const Bake> bake; ///< null if the technique needs none
    std::shared_ptr<const LightmapLayout> layout;
    std::unique_ptr<Lighting> lighting;
    LightingReport report;

    const IndirectField& field() const { return *lighting->field(); }
};

/// Lights a scene. Reads the bake from `bakeFile`, or bakes with the scene's settings if that is
/// empty. Fails, with the file's name, where it is the bake of another scene.
Result<LitScene> lightScene(Scene scene, const std::string& bakeFile, const MemoryBudget& memory,
                            const Progress& progress);

} // namespace limn
