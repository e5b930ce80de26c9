// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/stress/stress_case.h"

namespace limn {

struct MinimiseLimits {
    int tries = 300;
    double seconds = 60;     ///< in all
    double caseSeconds = 10; ///< of one try
};

/// What is left of a case that `oracle` fails when objects, lights, triangles and whatever differs
/// from a plain scene are taken away, one after the other, as long as it fails. The case itself
/// where that does not fail again.
StressCase minimised(const StressCase& failing, const Oracle& oracle, const std::string& folder,
                     const MinimiseLimits& limits = {});

} // namespace limn
