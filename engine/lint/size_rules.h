// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lint/lint_scene.h"

namespace limn {

/// Diagonal of a mesh over that of the scene, below which it is lost: world positions are floats of
/// 24 bits, so that it would have 16 steps of rounding across.
inline constexpr double kTinyMesh = 1e-6;

/// Diagonals of scenes that lengths in metres make plausible [m]: a thimble, a city.
inline constexpr double kMinScene = 0.01, kMaxScene = 1e5;

extern const LintRule kTinyMeshRule, kSceneSizeRule, kDegenerateTrianglesRule, kNonFiniteRule,
    kRepairedFileRule;

/// Sizes that are no accident of taste, triangles without a plane, and what the importer repaired.
std::vector<Finding> sizeFindings(const LintScene& in);

} // namespace limn
