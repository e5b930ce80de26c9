// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/bake_settings.h"

#include <span>

namespace limn {

/// The error of a bake's light as it was measured: nRMSE of the irradiance at points that the view
/// of then showed, in the light of then.
struct MeasuredError {
    BakeSettings settings;
    double nrmse = 0;
};

/// The error of the settings that are most alike `settings`, the newest of several; null where
/// none is so alike that it would say something: within two doublings of counts, summed up, or two
/// other settings.
const MeasuredError* nearestError(std::span<const MeasuredError> errors,
                                  const BakeSettings& settings);

} // namespace limn
