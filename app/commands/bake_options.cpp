// SPDX-License-Identifier: MIT
#include "app/commands/bake_options.h"

#include "engine/core/hash.h"
#include "engine/json/json.h"
#include "engine/scene/bake_settings_fields.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <type_traits>

#include <fmt/format.h>

namespace limn {

/// "draft, medium or high".
static std::string presetNames() {
    std::string names;
    for (const BakePreset& p : kBakePresets)
        names += fmt::format("{}{}",
                             names.empty()                ? ""
                             : &p == &kBakePresets.back() ? " or "
                                                          : ", ",
                             p.name);
    return names;
}

static const BakePreset* presetNamed(const std::string& name) {
    const auto* found = std::ranges::find(kBakePresets, name, &BakePreset::name);
    return found == kBakePresets.end() ? nullptr : found;
}

void addBakeOptions(Command& command, BakeOptions& o) {
    command
        .option(
            "--preset", [&o](const std::string& name) { o.preset = presetNamed(name); },
            "Surfels, links, rays and lightmap caches that go together: " + presetNames() +
                "; other options replace single ones")
        .check([](const std::string& name) {
            return presetNamed(name) ? "" : fmt::format("\"{}\" is not {}", name, presetNames());
        });
    const BakeSettings defaults;
    std::map<std::string, Option> byKey;
    visitBakeSettings(defaults, [&](const Setting& setting, const auto&, const auto&... limits) {
        byKey.emplace(setting.key, addSettingOption(
                                       command, o.given, setting,
                                       [](const std::string& key, const std::string& text) {
                                           BakeSettings scratch;
                                           return setBakeSetting(scratch, key, text);
                                       },
                                       limits...));
    });
    visitBakeSettings(defaults, [&](const Setting& setting, const auto&, const auto&...) {
        if (setting.replaces)
            byKey.at(setting.replaces).excludes(byKey.at(setting.key));
    });
    command.option("--threads", o.threads, "Threads to use; 0: all").within(0, 1024);
}

void applyBakeOptions(const BakeOptions& o, BakeSettings& s) {
    if (o.preset)
        o.preset->applyTo(s);
    for (const auto& [key, text] : o.given)
        setBakeSetting(s, key, text);
}

bool hasOption(const BakeOptions& options, std::string_view key) {
    return std::ranges::any_of(options.given,
                               [&](const auto& setting) { return setting.first == key; });
}

/// "chromaBands" as "chroma_bands".
static std::string snakeCase(const std::string& key) {
    std::string snake;
    for (const char c : key) {
        if (std::isupper(static_cast<unsigned char>(c)))
            snake += '_';
        snake += char(std::tolower(static_cast<unsigned char>(c)));
    }
    return snake;
}

Json settingsJson(const BakeSettings& settings) {
    Json json;
    visitBakeSettings(settings, [&](const Setting& s, const auto& value, const auto&... limits) {
        auto& out = json[snakeCase(s.key)];
        if constexpr (requires { value.x; })
            out = {value.x, value.y, value.z};
        else if constexpr (std::is_enum_v<std::decay_t<decltype(value)>>)
            ((out = limits.names[std::size_t(value)]), ...);
        else
            out = value;
    });
    return json;
}

static Json countsSummary(const std::vector<LightingCounter>& counters) {
    Json json;
    for (const LightingCounter& counter : counters)
        json[counter.id] = std::uint64_t(counter.value);
    return json;
}

Json bytesSummary(const std::vector<LightingCounter>& bytes) {
    Json json = countsSummary(bytes);
    json["total"] = std::uint64_t(totalOf(bytes));
    return json;
}

Json bakeSummary(const Precomputed& bake) {
    const PrecomputedReport report = bake.report();
    Json seconds;
    for (const auto& [stage, s] : report.seconds)
        seconds[stage] = s;
    seconds["total"] = totalOf(report.seconds);
    return {{"seconds", seconds},
            {"counts", countsSummary(report.counts)},
            {"bytes", bytesSummary(report.bytes)},
            {"notes", report.notes},
            {"hash", hexHash(bake.hash())}};
}

} // namespace limn
