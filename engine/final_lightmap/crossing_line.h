// SPDX-License-Identifier: MIT
#pragma once

#include "engine/final_lightmap/chart_pieces.h"

#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// The straight line through a part of a chart on which most crossings lie, if there are crossings
/// all along it where `samples` says that the part has surface. Removes those on it. Deterministic.
/// Fischler, Bolles. Random Sample Consensus. 1981
std::optional<ChartCuts::Node> crossingLine(std::vector<glm::vec2>& crossings,
                                            std::span<const ResidualSample> samples);

} // namespace limn
