// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command.h"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace limn {

using Json = nlohmann::ordered_json;

/// Writes `rows`, objects with the same keys, as NAME.csv and NAME.json into `folder`, which is
/// created if missing. With `json`, also prints them on stdout.
Exit writeRows(const Json& rows, const std::string& folder, const std::string& name, bool json);

/// A column of a printed table.
struct Column {
    const char* title;
    int width;       ///< negative: left-aligned and truncated
    const char* key; ///< of a row
    int decimals = 2;
    double scale = 1; ///< factor applied to the number
};
inline constexpr double kMiB = 1.0 / (1 << 20);
void printTitles(std::span<const Column> columns);
void printRow(std::span<const Column> columns, const Json& row);

/// The enumerator called `name`. Precondition: `name` is one of `names`.
template <class Enum, class Names>
Enum named(const Names& names, const std::string& name) {
    return Enum(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Adds an option that takes several comma-separated values.
template <class Values, class Check>
void addList(CLI::App& command, const char* flag, Values& values, const char* text,
             const Check& check) {
    command.add_option(flag, values, text)->delimiter(',')->check(check);
}

template <class Names>
CLI::IsMember oneOf(const Names& names) {
    return CLI::IsMember(std::vector<std::string>(names.begin(), names.end()));
}

} // namespace limn
