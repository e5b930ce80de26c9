// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/precomputed.h"
#include "engine/lint/lint_scene.h"

#include <string>

namespace limn {

extern const LintRule kBakeMemoryRule, kManyTexelsRule;

/// What a bake of the scene with its settings is expected to take.
Prediction forecastBake(const Scene& scene);

/// Seconds of each stage of that bake on this machine: a trial with the counts of a preview is made
/// and timed, and scaled by the method's model of its stages (`limn bench predict` says how well).
/// Takes a fraction of the bake's own time. Fails on an empty scene, where the trial would need
/// more than `memory`, and when cancelled.
Result<StageSeconds> forecastSeconds(const TraceScene& trace, const MemoryBudget& memory,
                                     const Progress& progress);

/// Whether the bake would be refused, or needs more texels than are asked for.
std::vector<Finding> forecastFindings(const LintScene& in);

} // namespace limn
