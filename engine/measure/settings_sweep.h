// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/bake_settings.h"

#include <map>
#include <string>
#include <vector>

namespace limn {

/// Values of bake settings to try in every combination, by the settings' keys, as
/// setBakeSetting() takes them. A setting without values keeps that of the settings it starts from.
using SettingsSweep = std::map<std::string, std::vector<std::string>>;

/// `start` with every combination of the values. Settings that need no new rays vary fastest, so
/// that rows reuse the stages of the rows before them.
std::vector<BakeSettings> sweepRows(const SettingsSweep& sweep, const BakeSettings& start = {});

/// The rows of a sweep from `start` that differ from `row` in one setting, by one step of its
/// values.
std::vector<BakeSettings> neighboursIn(const SettingsSweep& sweep, const BakeSettings& row);

/// How unlike settings are: the sum over the counts of the absolute log2 of their ratios, and 1 for
/// each other setting that costs and errors depend on and that differs.
double settingsDistance(const BakeSettings& a, const BakeSettings& b);

/// The settings that differ from those of the default, "surfels 16384, links 32"; "default" if none
/// does.
std::string settingsName(const BakeSettings& settings);

} // namespace limn
