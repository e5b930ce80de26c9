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

/// The moments of a cell towards an offset; 0 if it lies in a solid.
static glm::vec2 momentsTowards(const GridMoments& moments, std::uint32_t cell, glm::vec3 way) {
    const glm::vec2* texels = moments.texels.data() + std::size_t(cell) * kGridDepthTexels;
    if (!(glm::length(way) > 0))
        return texels[0];
    const GridDepthLookup lookup = gridDepthLookup(way);
    glm::vec2 here(0);
    for (std::size_t k = 0; k < 4; ++k)
        here += lookup.weight[k] * texels[lookup.texel[k]];
    return here;
}

float momentsSeen(const GridMoments& moments, std::uint32_t cell, glm::vec3 way) {
    const glm::vec2 here = momentsTowards(moments, cell, way);
    return here.y > 0 ? shareInFront(here, glm::length(way)) : 0;
}

float momentsWeight(const GridMoments& moments, std::uint32_t cell, glm::vec3 way,
                    glm::vec3 normal) {
    const float r = glm::length(way);
    const glm::vec2 here = momentsTowards(moments, cell, way);
    if (!(here.y > 0))
        return 0;
    if (!(r > 0))
        return 1;
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
