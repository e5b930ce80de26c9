// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/precomputed.h"

#include <string>

namespace limn {

/// Seconds left at `fraction` of `stage`, which has taken `stageSeconds` so far. Uses the stage's
/// own pace once that is known and the expected durations of the stages after it. A stage that is
/// not listed counts as part of the last one. A stage that takes longer than expected is thought to
/// take a quarter more than it has. Negative if unknown.
double secondsLeft(const StageSeconds& expected, const std::string& stage, double fraction,
                   double stageSeconds);

} // namespace limn
