// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lint/lint_scene.h"

namespace limn {

extern const LintRule kThinWallRule;

/// Walls that stand on a surface and are thinner than its texels, which then lie on both of their
/// sides. Texels are those that a bake with the scene's settings lays. Lookups keep to one side of
/// a wall to within an eighth of a texel; thinner walls are warnings, and others notes, for
/// programs whose lookups keep to no side. Where one side lies within a solid or behind a
/// one-sided surface, bakes know that no light is there. A wall is at least four texels high and
/// wide.
std::vector<Finding> wallFindings(const LintScene& in, const Progress& progress);

} // namespace limn
