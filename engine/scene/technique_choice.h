// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

namespace limn {

/// The technique of bounced light that lights the document. One per document.
struct TechniqueChoice {
    std::string technique = "illuminance"; ///< its name in the table of techniques
    /// Values of the technique's settings, by key; missing ones have their defaults.
    std::map<std::string, double> settings;

    bool operator==(const TechniqueChoice&) const = default;
};

} // namespace limn
