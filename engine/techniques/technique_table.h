// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

#include <span>
#include <string>
#include <string_view>

namespace limn {

/// Every technique of bounced light, the default first.
std::span<const Technique* const> techniques();

/// The technique of that name, or null.
const Technique* findTechnique(std::string_view name);

/// "illuminance or ambient", for messages and --help.
std::string techniqueNames();

/// What is wrong with a document's choice: an unknown technique, or a setting that none has; empty:
/// nothing.
std::string choiceDefect(const TechniqueChoice& choice);

} // namespace limn
