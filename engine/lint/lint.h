// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lint/lint_scene.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace limn {

/// All rules, in the order of reports.
std::span<const LintRule* const> lintRules();

/// What makes the light of a scene go wrong: errors first, then warnings and notes, each in the
/// order of the rules. std::nullopt when cancelled. Takes seconds for scenes of some 100 000
/// triangles, because it cuts charts and lays texels as a bake does.
std::optional<std::vector<Finding>> lintScene(const LintScene& in, const Progress& progress = {});

/// Number of findings of each severity, by its value.
std::array<std::size_t, 3> countBySeverity(std::span<const Finding> findings);

} // namespace limn
