// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/json/json.h"

#include <map>
#include <string>

namespace limn {

/// Rows of a benchmark that a folder keeps as soon as each is finished, so that a run that was
/// stopped goes on where it ended. A row belongs to a key: a text that holds everything that the
/// row depends on. The file has one JSON object a line, {"key", "row"}.
class KeptRows {
public:
    /// Reads the rows in `folder`/NAME.rows, where there are any; `folder` is created if missing.
    /// Fails on a file that is something else, and names it and the line.
    static Result<KeptRows> open(const std::string& folder, const std::string& name);

    /// The row of the key; null: it has not been measured.
    const Json* find(const std::string& key) const;

    /// Keeps a row, whenever the program stops. Fails if the file cannot be written.
    Result<void> keep(const std::string& key, const Json& row);

private:
    std::string m_path;
    std::string m_text; ///< of the file
    std::map<std::string, Json> m_rows;
};

} // namespace limn
