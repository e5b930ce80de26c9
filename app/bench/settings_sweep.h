// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command_line.h"
#include "engine/measure/settings_sweep.h"

namespace limn {

/// Adds an option with a comma-separated list for every setting. Given values
/// replace those in `sweep`.
void addSweepOptions(Command& command, SettingsSweep& sweep);

} // namespace limn
