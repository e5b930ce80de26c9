// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/final_lightmap/lit_texels.h"

#include <functional>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Light at a point of a surface, that a lightmap is to show.
using LightOfPoint = std::function<glm::vec3(const Hit& hit)>;

/// Factors of charts with which a lightmap of so many texels has about the least squared relative
/// error:
/// a trial lightmap is fitted to `light`, and what is left of it tells where texels are too few, as
/// beside edges of light and around thin columns. Where the squared error falls in proportion to
/// the number of texels, it is least where each chart has texels in proportion to the square root
/// of its squared error times its texels. Starts from `factors`, each of which it changes by 0.7 to
/// 2 times: the light that it knows is that of a bake, not the final one. Incomplete when
/// cancelled.
ChartFactors factorsByResidual(const Scene& scene, const std::vector<MeshCharts>& charts,
                               ChartFactors factors, const LitTexelCount& count,
                               const LightOfPoint& light, const Progress& progress);

} // namespace limn
