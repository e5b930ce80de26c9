// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lint/finding.h"

#include <memory>
#include <string>
#include <vector>

namespace limn {

/// The list of what makes the light of the scene go wrong.
struct LintState {
    bool running = false;
    std::string stage;                ///< of the check that is running
    float fraction = 0;               ///< of that stage
    std::string error;                ///< of the last check
    bool outdated = false;            ///< the document has changed since `findings` were found
    std::vector<std::string> repairs; ///< what the importer repaired in the scene's file
    std::shared_ptr<const std::vector<Finding>> findings; ///< null: nothing was checked yet
};

} // namespace limn
