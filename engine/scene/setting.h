// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace limn {

/// What becomes out of date when a setting changes.
enum class Invalidates : std::uint8_t {
    Bake, ///< the precomputed data
    Light ///< the light alone: the next frames show the change
};

/// Description of a setting, shared by everything that lists, reads, writes or checks settings:
/// project files, the command line, the inspector, the baker.
struct Setting {
    const char* key;               ///< in project and bake files
    const char* flag = nullptr;    ///< on the command line, "--rays"; null: it has none
    const char* label = nullptr;   ///< in the inspector, with its symbol or unit
    const char* help = nullptr;    ///< for --help, one phrase
    const char* tooltip = nullptr; ///< for the inspector, whole sentences
    Invalidates invalidates = Invalidates::Bake;
    /// Key of a setting that the command line sets to 0 together with this one, because only one of
    /// the two can be in effect; null: none.
    const char* replaces = nullptr;
    /// The inspector lists settings by group, in the order of these numbers.
    int group = 0;
    bool applies = true; ///< false: other settings leave it without effect
};

/// Range of a numeric setting.
struct SettingRange {
    double lower = 0, upper = 1;
    /// Lowest number that the command line accepts. A `lower` of 0 may mean "not set".
    double lowest = lower;
};

/// The values of an enumeration, in its order.
struct SettingChoices {
    std::span<const std::string_view> names; ///< in files and on the command line
    std::span<const char* const> labels;     ///< for people
};

} // namespace limn
