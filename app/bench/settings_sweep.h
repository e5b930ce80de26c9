// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/bake_settings.h"

#include <CLI/CLI.hpp>

#include <map>
#include <string>
#include <vector>

namespace limn {

/// Values of bake settings to try in every combination, by the settings' keys, as
/// setBakeSetting() takes them. A setting without values keeps its default.
using SettingsSweep = std::map<std::string, std::vector<std::string>>;

/// A list between commas for every setting that has a flag. What is given there replaces the
/// values that `sweep` has.
void addSweepOptions(CLI::App& command, SettingsSweep& sweep);

/// A row of settings for each combination. What needs no new rays varies fastest, so that rows
/// find the stages of the rows before them.
std::vector<BakeSettings> sweepRows(const SettingsSweep& sweep);

} // namespace limn
