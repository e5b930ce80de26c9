// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command_line.h"
#include "engine/scene/bake_settings.h"

#include <map>
#include <string>
#include <vector>

namespace limn {

/// Values of bake settings to try in every combination, by the settings' keys, as
/// setBakeSetting() takes them. A setting without values keeps its default.
using SettingsSweep = std::map<std::string, std::vector<std::string>>;

/// Adds an option with a comma-separated list for every setting. Given values
/// replace those in `sweep`.
void addSweepOptions(Command& command, SettingsSweep& sweep);

/// One row of settings per combination. Settings that need no new rays vary fastest, so that rows
/// reuse the stages of the rows before them.
std::vector<BakeSettings> sweepRows(const SettingsSweep& sweep);

} // namespace limn
