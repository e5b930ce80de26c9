// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lint/lint_scene.h"

namespace limn {

/// Share of the direct light at a point below which nobody sees a light: the eye's threshold of
/// contrast is about a hundredth (Weber's law).
inline constexpr float kSeenShare = 0.01f;

/// What no lamp sends or gives: the sun's illuminance above the air [lux], its luminance [nits],
/// and the intensity of the largest searchlights [cd].
inline constexpr float kSunLux = 133000, kSunNits = 1.6e9f, kSearchlightCandela = 1e6f;

extern const LintRule kDarkSceneRule, kZeroLightRule, kUnseenLightRule, kDimLightRule,
    kStrongLightRule;

/// Lights whose unit or place is wrong. Direct light alone is compared: that of lights, emissive
/// surfaces and the sky at points spread over all surfaces, shadows included. Lights that are off
/// are left out.
std::vector<Finding> lightFindings(const LintScene& in, const Progress& progress);

} // namespace limn
