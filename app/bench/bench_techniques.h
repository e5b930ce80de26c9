// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command.h"

namespace limn {

/// Adds `limn bench techniques`: all techniques on the same scenes, by time, memory and error.
void addTechniquesBench(Command& bench);

} // namespace limn
