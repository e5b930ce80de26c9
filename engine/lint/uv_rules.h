// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lint/lint_scene.h"

namespace limn {

extern const LintRule kMissingUvRule, kDegenerateUvRule, kLightmapUvRule;

/// Coordinates that textures and lightmaps need. Textures repeat, so that overlaps matter only for
/// the lightmap: for TEXCOORD_1, where no texture of the mesh reads it, it lies within [0, 1] and
/// is no copy of TEXCOORD_0. Without it, or where it is unusable, bakes cut charts of their own.
std::vector<Finding> uvFindings(const LintScene& in, const Progress& progress);

} // namespace limn
