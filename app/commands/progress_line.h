// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"

namespace limn {

/// Shows stage and per cent on stderr: one line that rewrites itself on a terminal, else one line
/// per stage.
Progress progressOnStderr();

/// Ends the terminal's line. Call when the job is done.
void endProgressLine();

} // namespace limn
