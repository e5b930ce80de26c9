// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/lighting/technique.h"

#include <memory>
#include <string>

namespace limn {

/// A scene lit to convergence on the CPU by the technique that its document names.
struct LitScene {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const TraceScene> trace;
    Prepared prepared; ///< by the technique, where it precomputes
    std::shared_ptr<const LightmapLayout> layout;
    std::unique_ptr<Lighting> lighting;
    LightingReport report;

    const IndirectField& field() const { return *lighting->field(); }
};

/// Lights a scene. Reads what its technique precomputed from `bakeFile`, or precomputes it with the
/// scene's settings if that is empty. Fails, with the file's name, where it is of another scene.
Result<LitScene> lightScene(Scene scene, const std::string& bakeFile, const MemoryBudget& memory,
                            const Progress& progress);

} // namespace limn
