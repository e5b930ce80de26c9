// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command_line.h"
#include "engine/core/result.h"
#include "engine/scene/technique_choice.h"

#include <string>
#include <vector>

namespace limn {

/// --technique and --set.
struct TechniqueOptions {
    std::string technique;             ///< empty: the document's
    std::vector<std::string> settings; ///< of techniques, KEY=NUMBER
};
void addTechniqueOptions(Command& command, TechniqueOptions& options);

/// Applies the options to the document's choice. Fails on a setting that no technique has.
Result<void> chooseTechnique(const TechniqueOptions& options, TechniqueChoice& choice);

} // namespace limn
