// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/settings_sweep.h"

#include "engine/lighting/technique.h"

#include <string>
#include <vector>

namespace limn {

/// Settings of a technique that are measured together.
struct Variant {
    std::string name;
    TechniqueChoice choice;
    BakeSettings bake; ///< read by techniques that precompute
};

/// The settings to measure. Where `varied` has settings of the technique, or of bakes and the
/// technique precomputes, every combination of their values; the first key varies slowest. Else
/// from coarse to fine: the presets for a technique that precomputes, or the defaults and a quarter
/// to four times the default of the technique's first setting, unless that is a switch.
std::vector<Variant> variantsOf(const Technique& technique, const BakeSettings& bake,
                                const SettingsSweep& varied = {});

/// What is wrong with the text "KEY=VALUE,VALUE,...", where KEY is a setting of some technique,
/// such as "probes.count", or of bakes, such as "surfels"; empty: nothing.
std::string variedDefect(const std::string& text);

/// The values of such texts, none of which has a defect. Of two texts with the same key, the later
/// one counts.
SettingsSweep variedSettings(const std::vector<std::string>& texts);

} // namespace limn
