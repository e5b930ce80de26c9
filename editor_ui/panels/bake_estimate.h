// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"

#include <string>
#include <utility>
#include <vector>

namespace limn {

/// Seconds that each stage is expected to take, in their order. Empty: nothing is known.
using StageSeconds = std::vector<std::pair<std::string, double>>;

/// What a bake with `wanted` settings should take, from one of the same scene: tracing by the rays,
/// the cut by their root (measured: 0.17 s at 64 rays, 0.84 s at 1024), the rest by the surfels.
StageSeconds expectedSeconds(const Bake& before, const BakeSettings& wanted);

/// Seconds left at `fraction` of `stage`, which has taken `stageSeconds` so far: its own pace once
/// that shows, and what is expected of the stages after it. A stage that is not listed is a part of
/// the last one. Negative: not known.
double secondsLeft(const StageSeconds& expected, const std::string& stage, double fraction,
                   double stageSeconds);

/// The settings of a first look at a scene: few rays, links and surfels, the same texels.
BakeSettings previewSettings(BakeSettings settings);

} // namespace limn
