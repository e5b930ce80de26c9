// SPDX-License-Identifier: MIT
#pragma once

#include "engine/final_lightmap/fit_texels.h"
#include "engine/final_lightmap/lit_texels.h"

#include <cstdint>
#include <vector>

namespace limn {

/// A point of an open texel at which a lightmap is to be right.
struct FittedPoint {
    std::uint32_t texel, point; ///< point of the texel
};

/// The points of all open texels.
std::vector<FittedPoint> fittedPoints(const LitTexels& lit);

/// That point of `scene`, before it was cut, as a ray from above hits it.
Hit hitOf(const Scene& scene, const CutScene& cut, const LitTexels& lit, const FittedPoint& p);

/// What texels are fitted to at those points. The points of a texel together count as much as those
/// of any other that has surface inside. `scene` is the cut one.
TexelFitInput fitInput(const Scene& scene, const LitTexels& lit,
                       const std::vector<FittedPoint>& points);

/// The mean light of each texel's points; 0 where a texel has none.
template <class Light>
std::vector<Light> meanOfTexels(const LitTexels& lit, const std::vector<FittedPoint>& points,
                                const std::vector<Light>& light) {
    std::vector<Light> mean(lit.atlas.texels.size(), Light(0));
    for (std::size_t p = 0; p < points.size(); ++p)
        mean[points[p].texel] += light[p] / float(lit.atlas.texels[points[p].texel].count);
    return mean;
}

} // namespace limn
