// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/bake_settings.h"

#include <span>
#include <vector>

namespace limn {

/// The error of a bake's light as it was measured: nRMSE of the irradiance at points that the view
/// of then showed, in the light of then.
struct MeasuredError {
    BakeSettings settings;
    double nrmse = 0;
};

/// What bakes aim at when somebody asks for an error or for a budget, and what was measured then.
struct BakeGoals {
    float maxError = 0.2f; ///< nRMSE of a bake to an error
    float budgetMs = 5;    ///< of an update [ms]
    float budgetMiB = 32;  ///< of a bake with what updates read and write beside it [MiB]
    double seconds = 270;  ///< for the search within a budget
    std::vector<MeasuredError> errors; ///< of bakes of this scene, in this session
};

/// The error of the settings that are most alike `settings`, the newest of several; null where
/// none is so alike that it would say something: within two doublings of counts, summed up, or two
/// other settings.
const MeasuredError* nearestError(std::span<const MeasuredError> errors,
                                  const BakeSettings& settings);

} // namespace limn
