// SPDX-License-Identifier: MIT
#pragma once

#include "engine/measure/compare.h"
#include "engine/techniques/illuminance/bake/bake.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace limn {

/// A bake and the error of its light.
struct MeasuredBake {
    std::shared_ptr<const Bake> bake;
    Comparison error; ///< of the irradiance, direct and bounced, at 96 x 54 points that are seen
    enum class End : std::uint8_t {
        Held,     ///< the error is at most the one asked for
        NoBetter, ///< twice as many texels lowered it by less than a tenth, two times in a row
        Memory,   ///< a finer bake would need more than it may
        Finest    ///< no settings are finer
    } end = End::Held;
};

struct ErrorGoal {
    double nrmse = 0.1; ///< the most that Comparison::nrmse may be
    Camera camera;      ///< where light is looked at
};

/// Settings with twice as many texels, and with more surfels and links in the proportion of the
/// presets. Equal to `settings` where none are finer.
BakeSettings finerSettings(const BakeSettings& settings);

/// Bakes with the settings of the scene, and with finer ones again and again until the error in the
/// scene's light meets the goal. Gives the bake of the least error where none does. `baked` is told
/// each bake as it comes. Fails as bake() does, and where the camera sees no light.
Result<MeasuredBake> bakeToError(const TraceScene& trace, const ErrorGoal& goal,
                                 const Progress& progress = {}, StageStore* store = nullptr,
                                 const MemoryBudget& memory = {},
                                 const std::function<void(const MeasuredBake&)>& baked = {});

} // namespace limn
