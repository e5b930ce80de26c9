// SPDX-License-Identifier: MIT
#include "engine/scene/setting_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace limn {

/// Range of numbers that the command line accepts.
static SettingRange written(const SettingRange& range) {
    return {range.lowest, range.upper};
}

std::string numberDefect(double value, const SettingRange& range) {
    if (value >= range.lower && value <= range.upper)
        return {};
    return fmt::format("{} is outside [{}, {}]", value, range.lower, range.upper);
}

template <class T>
static std::string readNumber(const std::string& text, T& value, const SettingRange& range) {
    T number{};
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    if (error == std::errc::result_out_of_range)
        return fmt::format("{} is outside [{}, {}]", text, range.lowest, range.upper);
    if (error != std::errc() || rest != end)
        return fmt::format("\"{}\" is not a {}number", text, std::is_integral_v<T> ? "whole " : "");
    std::string defect = numberDefect(double(number), written(range));
    if (defect.empty())
        value = number;
    return defect;
}

std::string readValue(const std::string& text, std::uint32_t& value, const SettingRange& range) {
    return readNumber(text, value, range);
}

std::string readValue(const std::string& text, float& value, const SettingRange& range) {
    return readNumber(text, value, range);
}

std::string readValue(const std::string& text, glm::uvec3& value, const SettingRange& range) {
    glm::uvec3 cells{0};
    std::size_t begin = 0;
    for (int c = 0; c < 3; ++c) {
        const std::size_t end = c < 2 ? text.find('x', begin) : text.size();
        if (end == std::string::npos ||
            !readNumber(text.substr(begin, end - begin), cells[c], range).empty())
            return fmt::format("\"{}\" is not XxYxZ, each {} to {}", text, range.lowest,
                               range.upper);
        begin = end + 1;
    }
    value = cells;
    return {};
}

std::string readValue(const std::string& text, bool& value) {
    if (text != "true" && text != "false")
        return fmt::format("\"{}\" is not true or false", text);
    value = text == "true";
    return {};
}

std::string readChoice(const std::string& text, std::size_t& value, const SettingChoices& choices) {
    const auto found = std::ranges::find(choices.names, text);
    if (found == choices.names.end())
        return fmt::format("\"{}\" is not one of {}", text, fmt::join(choices.names, ", "));
    value = std::size_t(found - choices.names.begin());
    return {};
}

} // namespace limn
