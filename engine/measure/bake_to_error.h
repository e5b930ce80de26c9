// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"
#include "engine/measure/compare.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace limn {

/// A bake and the error of its light.
struct MeasuredBake {
    std::shared_ptr<const Precomputed> bake;
    Comparison error; ///< of the irradiance, direct and bounced, at 96 x 54 visible points
    enum class End : std::uint8_t {
        Held,     ///< the error is at most the goal
        NoBetter, ///< doubling the texels lowered it by less than a tenth, twice in a row
        Memory,   ///< a finer bake would need more memory than allowed
        Finest    ///< no settings are finer
    } end = End::Held;
};

struct ErrorGoal {
    double nrmse = 0.1; ///< maximum Comparison::nrmse
    Camera camera;      ///< camera whose visible points are compared
};

/// Why the error of `made` exceeds `error`; empty if it does not.
std::string shortfall(const MeasuredBake& made, double error);

/// Settings with twice as many texels, and with more surfels, links and rays in the proportion of
/// the presets. Equal to `settings` where none are finer.
BakeSettings finerSettings(const BakeSettings& settings);

/// Bakes with the scene's settings, then with ever finer ones until the error in the scene's light
/// meets the goal. Returns the bake of the least error where none meets it. `baked` is called with
/// each bake when it is done. Fails as Precomputation::prepare() does, and where the camera sees no
/// light. Precondition: `technique` precomputes.
Result<MeasuredBake> bakeToError(const Technique& technique, const TraceScene& trace,
                                 const ErrorGoal& goal, const Progress& progress = {},
                                 StageStore* store = nullptr, const MemoryBudget& memory = {},
                                 const std::function<void(const MeasuredBake&)>& baked = {});

} // namespace limn
