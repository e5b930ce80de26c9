// SPDX-License-Identifier: MIT
#include "app/bench/settings_sweep.h"

#include "engine/scene/bake_settings_fields.h"

#include <string>
#include <vector>

namespace limn {

void addSweepOptions(Command& command, SettingsSweep& sweep) {
    const BakeSettings defaults;
    visitBakeSettings(defaults, [&](const Setting& setting, const auto&, const auto&...) {
        const std::string key = setting.key;
        command
            .listOption(
                setting.flag,
                [&sweep, key](const std::vector<std::string>& values) { sweep[key] = values; },
                std::string(setting.help) + ", a list")
            .list()
            .check([key](const std::string& text) {
                BakeSettings scratch;
                return setBakeSetting(scratch, key, text);
            });
    });
}

} // namespace limn
