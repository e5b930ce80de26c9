// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/final_lightmap/lit_texels.h"

#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// Position in the plane of a chart of a point of its mesh [object units].
glm::vec2 chartUvAt(const MeshCharts& charts, const MeshPoint& point);

/// Points in the planes of charts, per instance and chart of a scene before it was cut.
using ChartCrossings = std::vector<std::vector<std::vector<glm::vec2>>>;

/// Where other surfaces cross charts: where rays along the surface, between the points of a texel
/// and of the next ones, meet anything but their own chart. `charts` are per mesh. Incomplete when
/// cancelled.
ChartCrossings findCrossings(const TraceScene& trace, const std::vector<MeshCharts>& charts,
                             const CutScene& cut, const LitTexels& lit, const Progress& progress);

} // namespace limn
