// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/picture/explain_pixel.h"

#include <cstdint>
#include <span>
#include <vector>

namespace limn {

/// The light that a pixel is to have.
struct StrengthGoal {
    PixelQuestion question;
    double luminance = 0; ///< of `question.light`, in its unit, > 0

    bool operator==(const StrengthGoal&) const = default;
};

struct SolvedStrengths {
    std::vector<double> factor; ///< of the strength of each of Scene::lights, >= 0
    struct AtGoal {
        double before = 0, after = 0; ///< luminance, now and in the scene with the factors
    };
    std::vector<AtGoal> goals;
};

/// Finds factors of the strengths of `lights` (indices into Scene::lights) with which the goals'
/// pixels come as near to their luminances as they can: the sum of squared relative differences is
/// the least. The light of a pixel is linear in the strengths, so that its explanation tells all
/// that is needed, bounces included. How far gathered light is trusted is not linear, so that the
/// scene is lit with what was found, and solved again where that differs. Where many factors serve
/// the goals, those nearest to 1 are taken. Other lights, the sky and emissive surfaces keep what
/// they send; lights that are off stay so. `technique` is the one that made `lit`. Fails where none
/// of the lights reaches a goal, and when cancelled. Schoeneman, Dorsey, Smits, Arvo, Greenberg.
/// Painting with Light. 1993
Result<SolvedStrengths> solveStrengths(const ConvergedLight& lit, const Technique& technique,
                                       std::span<const StrengthGoal> goals,
                                       std::span<const std::uint32_t> lights,
                                       const Progress& progress = {});

} // namespace limn
