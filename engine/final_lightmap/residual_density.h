// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/final_lightmap/cut_scene.h"
#include "engine/final_lightmap/lit_texels.h"

#include <functional>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Light at a point of a surface, that a lightmap is to show.
using LightOfPoint = std::function<glm::vec3(const Hit& hit)>;

/// Charts, and the density of texels in each.
struct CutDensity {
    CutScene cut;
    ChartFactors factors; ///< of the charts of `cut`
};

/// Charts and factors with which a lightmap of so many texels has about the least squared relative
/// error: a trial lightmap is fitted to `light`, and what is left of it tells where texels are too
/// few, as beside edges of light and around thin columns. Where the squared error falls in
/// proportion to the number of texels, it is least where each chart has texels in proportion to the
/// square root of its squared error times its texels. With `cutCharts`, charts that other surfaces
/// cross, or whose parts differ, are cut into pieces. Starts from the charts of `scene`, which are
/// per mesh, and `factors`. Incomplete when cancelled.
CutDensity densityByResidual(const TraceScene& trace, const std::vector<MeshCharts>& charts,
                             ChartFactors factors, const LitTexelCount& count, bool cutCharts,
                             const LightOfPoint& light, const Progress& progress);

} // namespace limn
