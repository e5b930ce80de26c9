// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command_line.h"
#include "engine/scene/setting.h"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace limn {

/// Keys of settings and the texts that the command line gave for them, already checked.
using GivenSettings = std::vector<std::pair<std::string, std::string>>;

// What --help shows in place of a setting's value.

inline std::string typeName(const SettingRange& range) {
    return fmt::format("NUMBER in [{}, {}]", range.lowest, range.upper);
}
inline std::string typeName(const SettingChoices& choices) {
    return fmt::format("{}", fmt::join(choices.names, " or "));
}
inline std::string typeName() {
    return "true or false";
}

/// Adds the option of a setting that has a flag. Its texts are appended to `given`, which must
/// outlive the command. `defectOf(key, text)` describes what is wrong with a text; empty: nothing.
template <class DefectOf, class... Limits>
Option addSettingOption(Command& command, GivenSettings& given, const Setting& setting,
                        const DefectOf& defectOf, const Limits&... limits) {
    const std::string key = setting.key;
    Option option = command.option(
        setting.flag, [&given, key](const std::string& text) { given.emplace_back(key, text); },
        setting.help);
    option.typeName(typeName(limits...)).check([key, defectOf](const std::string& text) {
        return defectOf(key, text);
    });
    return option;
}

} // namespace limn
