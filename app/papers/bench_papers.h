// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command.h"

namespace limn {

/// Adds `limn bench papers`: the papers' tables and figures, ours beside the printed ones.
void addPapersBench(Command& bench);

} // namespace limn
