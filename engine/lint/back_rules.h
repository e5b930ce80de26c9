// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lint/lint_scene.h"

namespace limn {

extern const LintRule kBackFacesRule;

/// One-sided objects that are seen from behind more than twice as much as from in front. Backs are
/// black and block light: such a room has normals that face outwards, and such a thing is inside
/// out. Cameras and lamps see, and so do the fronts of surfaces that they see, over four bounces;
/// without cameras and lamps, all surfaces that see hardly any backs. What lies within solids thus
/// counts for nothing. Surfaces of the same object do not count as seeing it.
std::vector<Finding> backFindings(const LintScene& in, const Progress& progress);

} // namespace limn
