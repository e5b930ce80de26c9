// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lint/lint_scene.h"

namespace limn {

/// Mean diffuse reflectance, largest channel, below which no painted surface lies: coal and black
/// paint have 0.03 to 0.05, black velvet 0.01.
inline constexpr float kBlackAlbedo = 0.005f;

/// The same above which none lies: fresh snow has 0.9, white paint 0.85. At 0.95, light bounces
/// some 1 / (1 - 0.95) = 20 times before it is lost.
inline constexpr float kBrightAlbedo = 0.95f;

extern const LintRule kBlackAlbedoRule, kBrightAlbedoRule;

/// Objects whose mean albedo is that of no paint. Those that emit, and glass, have no paint, nor do
/// metals.
std::vector<Finding> albedoFindings(const LintScene& in);

} // namespace limn
