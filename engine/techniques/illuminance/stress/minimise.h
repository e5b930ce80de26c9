// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/stress/stress_case.h"

namespace limn {

struct MinimiseLimits {
    int tries = 300;
    double seconds = 60;     ///< maximum for all tries together
    double caseSeconds = 10; ///< maximum for one try
};

/// Reduces a case that fails `oracle`: removes objects, lights, triangles and everything that
/// differs from a plain scene, one after the other, as long as the case still fails. Returns the
/// case itself where it does not fail again.
StressCase minimised(const StressCase& failing, const Oracle& oracle, const std::string& folder,
                     const MinimiseLimits& limits = {});

} // namespace limn
