// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/setting.h"

#include <concepts>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

namespace limn {

// Checks and parses values of settings. Every function returns a description of the error, such as
// "70000 is outside [16, 65536]", or an empty string on success.

std::string numberDefect(double value, const SettingRange& range);

template <class T>
std::string valueDefect(const T& value, const SettingRange& range) {
    if constexpr (requires { value.x; }) {
        for (int c = 0; c < T::length(); ++c)
            if (std::string defect = numberDefect(double(value[c]), range); !defect.empty())
                return defect;
        return {};
    } else {
        return numberDefect(double(value), range);
    }
}
template <class T>
requires std::is_enum_v<T> std::string valueDefect(T value, const SettingChoices& choices) {
    return std::size_t(value) < choices.names.size() ? "" : "is unknown";
}
inline std::string valueDefect(bool) {
    return {};
}

/// Parses a number in [range.lowest, range.upper], a name of the choices, three whole numbers
/// "XxYxZ", or "true" or "false".
std::string readValue(const std::string& text, std::uint32_t& value, const SettingRange& range);
std::string readValue(const std::string& text, float& value, const SettingRange& range);
std::string readValue(const std::string& text, glm::uvec3& value, const SettingRange& range);
std::string readValue(const std::string& text, bool& value);
std::string readChoice(const std::string& text, std::size_t& value, const SettingChoices& choices);
template <class T>
requires std::is_enum_v<T> std::string readValue(const std::string& text, T& value,
                                                 const SettingChoices& choices) {
    std::size_t index = 0;
    std::string defect = readChoice(text, index, choices);
    if (defect.empty())
        value = T(index);
    return defect;
}

/// Parses a value of the setting of that key, and sets the one that it replaces to nothing.
/// visitAll(visit) calls visit() for each setting, as visitBakeSettings() does. Returns what is
/// wrong with the text.
template <class VisitAll>
std::string setByKey(const VisitAll& visitAll, std::string_view key, const std::string& text) {
    std::string defect;
    const char* replaced = nullptr;
    visitAll([&](const Setting& setting, auto& value, const auto&... limits) {
        if (setting.key != key)
            return;
        defect = readValue(text, value, limits...);
        replaced = setting.replaces;
    });
    if (defect.empty() && replaced)
        visitAll([&](const Setting& setting, auto& value, const auto&...) {
            if (setting.key == std::string_view(replaced))
                value = {};
        });
    return defect;
}

} // namespace limn
