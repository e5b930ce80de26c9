// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/trace/trace_scene.h"

namespace limn {

class StageStore;

/// Bakes a scene. Stages reported: charts, surfels, clusters, caches, trace, training, cut. Stages
/// found in `store` are reused: the result is the same, and counts.rays counts the rays traced now.
/// Backs that leaveOutDarkBacks() finds are left out; they alone depend on cameras and lights.
/// `settings` replace the scene's own. Fails on an empty scene, on settings out of range, when
/// cancelled ("cancelled"), and where predictBake() expects more than `memory`.
Result<Bake> bake(const TraceScene& trace, const Progress& progress = {},
                  StageStore* store = nullptr, const BakeSettings* settings = nullptr,
                  const MemoryBudget& memory = {});

} // namespace limn
