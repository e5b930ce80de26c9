// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command.h"

#include "engine/json/json.h"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace limn {

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

} // namespace limn
