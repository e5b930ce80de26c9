// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"
#include "engine/measure/settings_sweep.h"
#include "engine/measure/successive_halving.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace limn {

/// What bake settings cost in a scene and the error of their light, as measured.
struct SettingsTrial {
    BakeSettings settings;
    int level = 0;      ///< of 0, 1 and 2; a higher one takes more points, paths and updates
    double seconds = 0; ///< of the bake's stages that were not kept [s]
    double ms = 0;      ///< least time of an update of one bounce, all lights moved, at this level
                        ///< and at those before it [ms]
    double bytes = 0;   ///< memory that updates read and write
    double nrmse = 0, bias = 0; ///< of irradiance, direct and bounced, at visible points
    double noise = 0;           ///< standard error of nrmse
};

struct BudgetGoal {
    SearchGoal limits;
    Camera camera;        ///< whose visible points are compared
    double seconds = 270; ///< for all measurements, about; at least one is made at each level
};

/// Settings that were found, and what was measured on the way.
struct FittedSettings {
    SettingsTrial best; ///< at the highest level that was reached
    bool kept = false;  ///< best keeps all limits
    std::vector<SettingsTrial> trials;
    std::size_t settings = 0, ruledOut = 0; ///< number of settings, and of those that are predicted
                                            ///< to exceed the limits
};

/// Values of settings to fit: surfels, links and texels in steps of 2 and of its root, and the
/// bands, storages and rays that are worth trying.
const SettingsSweep& usualFitSweep();

/// Why the settings do not keep the limits; empty if they do.
std::string shortfall(const FittedSettings& fitted, const SearchGoal& limits);

/// Finds the settings of `sweep`, starting from the scene's, that serve the goal best. One bake
/// with the counts of draft predicts what all others cost (Precomputed::expectedCost()), which
/// rules out most. Of those that are left, and than which none larger is predicted to keep the
/// limits, some are measured by successiveHalving(): at level 0 with 128 x 72 points, 8 paths and 3
/// updates, at the last level with 256 x 144 points, 16 paths and 9 updates. Errors are estimates
/// of what bakeToError() estimates from fewer points. `tried` is called with each trial. Fails as
/// Precomputation::prepare() does, where the camera sees no light, and when cancelled
/// ("cancelled"). Precondition: `technique` precomputes.
Result<FittedSettings> fitToBudget(const Technique& technique, const TraceScene& trace,
                                   const SettingsSweep& sweep, const BudgetGoal& goal,
                                   const Progress& progress = {}, const MemoryBudget& memory = {},
                                   const std::function<void(const SettingsTrial&)>& tried = {});

} // namespace limn
