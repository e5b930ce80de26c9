// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

namespace limn {

/// Which technique of bounced light the document is lit by. One per document.
struct TechniqueChoice {
    std::string technique = "illuminance"; ///< its name in the table of techniques
    /// Values of the techniques' own settings, by key; those that are missing have their defaults.
    std::map<std::string, double> settings;

    bool operator==(const TechniqueChoice&) const = default;
};

} // namespace limn
