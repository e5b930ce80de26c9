// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/fit_input.h"

namespace limn {

/// Weight of a texel that has no surface inside, and is known by the closest point of one. That
/// point stands for next to no area; at the edge of a moulding it may look through a crack.
static constexpr float kClosestWeight = 0.02f;
/// Weight of a texel in a narrow gap, beside that of an open one. Texels inside walls are such.
static constexpr float kNarrowWeight = 0.02f;

std::vector<FittedPoint> fittedPoints(const LitTexels& lit) {
    std::vector<FittedPoint> points;
    for (std::uint32_t t = 0; t < lit.atlas.texels.size(); ++t)
        for (std::uint32_t k = 0; lit.open[t] != Openness::Closed && k < lit.atlas.texels[t].count;
             ++k)
            points.push_back({t, k});
    return points;
}

Hit hitOf(const Scene& scene, const CutScene& cut, const LitTexels& lit, const FittedPoint& p) {
    const AtlasTexel& texel = lit.atlas.texels[p.texel];
    return hitOfPoint(scene, texel.instance, cut.toSource(texel.instance, texel.points[p.point]),
                      texel.back != 0);
}

TexelFitInput fitInput(const Scene& scene, const LitTexels& lit,
                       const std::vector<FittedPoint>& points) {
    TexelFitInput fit;
    fit.texels = lit.atlas.texels.size();
    fit.points.reserve(points.size());
    for (const FittedPoint& p : points) {
        const AtlasTexel& texel = lit.atlas.texels[p.texel];
        fit.points.push_back(lookUpTexels(lit, texel.instance, scene.instances[texel.instance].mesh,
                                          texel.points[p.point], texel.back != 0));
        fit.weights.push_back((texel.count == 1 ? kClosestWeight : 1 / float(texel.count)) *
                              (lit.open[p.texel] == Openness::Narrow ? kNarrowWeight : 1));
    }
    for (std::uint32_t t = 0; t < lit.atlas.texels.size(); ++t)
        forNextTexels(lit, t, [&](std::uint32_t next) { fit.neighbours.emplace_back(t, next); });
    fit.seams = findSeams(scene, lit);
    return fit;
}

} // namespace limn
