// SPDX-License-Identifier: MIT
#include "engine/field/grid_moments.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace limn {

float shareInFront(glm::vec2 moments, float r) {
    if (r <= moments.x)
        return 1;
    const float variance = std::max(moments.y - moments.x * moments.x, 0.f), excess = r - moments.x;
    return variance / (variance + excess * excess);
}

float momentsWeight(const GridMoments& moments, std::uint32_t cell, glm::vec3 way,
                    glm::vec3 normal) {
    const glm::vec2* texels = moments.texels.data() + std::size_t(cell) * kGridDepthTexels;
    const float r = glm::length(way);
    if (!(r > 0))
        return texels[0].y > 0 ? 1.f : 0.f;
    glm::vec2 here(0);
    const GridDepthLookup at = gridDepthLookup(way);
    for (std::size_t k = 0; k < 4; ++k)
        here += at.weight[k] * texels[at.texel[k]];
    if (!(here.y > 0)) // the cell lies in a solid
        return 0;
    const float facing = -glm::dot(normal, way) / r, seen = shareInFront(here, r);
    if (!moments.smooth)
        return std::max(std::max(float(MOMENTS_LEAST_FACING), facing) * seen,
                        float(MOMENTS_LEAST_WEIGHT));
    const float wrapped = (facing + 1) / 2;
    const float weight = std::max((wrapped * wrapped + float(MOMENTS_WRAP)) * seen * seen * seen,
                                  float(MOMENTS_SMOOTH_LEAST));
    return weight < float(MOMENTS_CRUSHED)
               ? weight * weight * weight / float(MOMENTS_CRUSHED * MOMENTS_CRUSHED)
               : weight;
}

} // namespace limn
