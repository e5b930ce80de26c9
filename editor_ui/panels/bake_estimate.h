// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"

#include <string>
#include <utility>
#include <vector>

namespace limn {

/// Expected duration of each stage in order [s]. Empty if unknown.
using StageSeconds = std::vector<std::pair<std::string, double>>;

/// Expected durations of a bake with `wanted` settings, scaled from a bake of the same scene:
/// tracing with the rays, the cut with their square root (measured: 0.17 s at 64 rays, 0.84 s at
/// 1024), the rest with the surfels.
StageSeconds expectedSeconds(const Bake& before, const BakeSettings& wanted);

/// Seconds left at `fraction` of `stage`, which has taken `stageSeconds` so far. Uses the stage's
/// own pace once that is known and the expected durations of the stages after it. A stage that is
/// not listed counts as part of the last one. Negative if unknown.
double secondsLeft(const StageSeconds& expected, const std::string& stage, double fraction,
                   double stageSeconds);

/// Settings of a preview bake: few rays, links and surfels, and the same texels.
BakeSettings previewSettings(BakeSettings settings);

} // namespace limn
