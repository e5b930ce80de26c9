// SPDX-License-Identifier: MIT
#include "editor_ui/panels/measured_errors.h"

#include "engine/measure/settings_sweep.h"

namespace limn {

const MeasuredError* nearestError(std::span<const MeasuredError> errors,
                                  const BakeSettings& settings) {
    constexpr double kTooFar = 2;
    const MeasuredError* nearest = nullptr;
    double least = kTooFar;
    for (const MeasuredError& error : errors)
        if (const double distance = settingsDistance(error.settings, settings); distance <= least) {
            nearest = &error;
            least = distance;
        }
    return nearest;
}

} // namespace limn
