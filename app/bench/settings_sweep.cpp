// SPDX-License-Identifier: MIT
#include "app/bench/settings_sweep.h"

#include "engine/scene/bake_settings_fields.h"

#include <algorithm>
#include <array>

namespace limn {

/// The settings that no ray depends on, in the order from the slowest-varying to the fastest.
static constexpr std::array<std::string_view, 6> kTracesNothing = {
    "bands", "chromaBands", "storage", "clustering", "cut", "links"};

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

std::vector<BakeSettings> sweepRows(const SettingsSweep& sweep) {
    std::vector<BakeSettings> rows = {BakeSettings{}};
    const auto vary = [&](const std::string& key) {
        const auto values = sweep.find(key);
        if (values == sweep.end() || values->second.empty())
            return;
        std::vector<BakeSettings> varied;
        for (const BakeSettings& row : rows)
            for (const std::string& value : values->second)
                setBakeSetting(varied.emplace_back(row), key, value);
        rows = std::move(varied);
    };
    for (const auto& [key, values] : sweep)
        if (std::ranges::find(kTracesNothing, key) == kTracesNothing.end())
            vary(key);
    for (const std::string_view key : kTracesNothing)
        vary(std::string(key));
    return rows;
}

} // namespace limn
