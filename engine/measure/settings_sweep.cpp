// SPDX-License-Identifier: MIT
#include "engine/measure/settings_sweep.h"

#include "engine/scene/bake_settings_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>

namespace limn {

/// The settings that no ray depends on, in the order from the slowest-varying to the fastest.
static constexpr std::array<std::string_view, 6> kTracesNothing = {
    "bands", "chromaBands", "storage", "clustering", "cut", "links"};

std::vector<BakeSettings> sweepRows(const SettingsSweep& sweep, const BakeSettings& start) {
    std::vector<BakeSettings> rows = {start};
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

std::vector<BakeSettings> neighboursIn(const SettingsSweep& sweep, const BakeSettings& row) {
    std::vector<BakeSettings> neighbours;
    for (const auto& [key, values] : sweep) {
        std::vector<BakeSettings> line;
        for (const std::string& value : values)
            setBakeSetting(line.emplace_back(row), key, value);
        const auto here = std::ranges::find(line, row);
        if (here == line.end())
            continue;
        if (here != line.begin())
            neighbours.push_back(*(here - 1));
        if (here + 1 != line.end())
            neighbours.push_back(*(here + 1));
    }
    return neighbours;
}

double settingsDistance(const BakeSettings& a, const BakeSettings& b) {
    const auto octaves = [](double x, double y) {
        return x > 0 && y > 0 ? std::abs(std::log2(x / y)) : x == y ? 0 : 1;
    };
    return octaves(a.surfels, b.surfels) + octaves(a.links, b.links) +
           octaves(a.lightmapCaches, b.lightmapCaches) + octaves(a.rays, b.rays) +
           octaves(a.texelsPerMetre, b.texelsPerMetre) + (a.bands != b.bands) +
           (a.storage != b.storage) + (a.chromaBands != b.chromaBands) + (a.cut != b.cut);
}

std::string settingsName(const BakeSettings& settings) {
    static const BakeSettings defaults;
    std::string name;
    const auto add = [&](std::string_view key, const std::string& text) {
        name += fmt::format("{}{} {}", name.empty() ? "" : ", ", key, text);
    };
    std::vector<std::string> usual;
    const auto textOf = [](const auto& value, const auto&... limits) -> std::string {
        if constexpr (requires { value.x; })
            return fmt::format("{}x{}x{}", value.x, value.y, value.z);
        else if constexpr (std::is_enum_v<std::decay_t<decltype(value)>>)
            return (std::string(limits.names[std::size_t(value)]) + ...);
        else
            return fmt::format("{}", value);
    };
    visitBakeSettings(defaults, [&](const Setting&, const auto& value, const auto&... limits) {
        usual.push_back(textOf(value, limits...));
    });
    std::size_t i = 0;
    visitBakeSettings(settings, [&](const Setting& s, const auto& value, const auto&... limits) {
        if (const std::string text = textOf(value, limits...); text != usual[i++])
            add(s.flag + 2, text);
    });
    return name.empty() ? "default" : name;
}

} // namespace limn
