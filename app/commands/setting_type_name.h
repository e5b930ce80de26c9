// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/setting.h"

#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace limn {

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

} // namespace limn
