// SPDX-License-Identifier: MIT
#include "engine/field/grid_depth.h"

#include "engine/math/octahedral.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace limn {

namespace {

constexpr int kSide = int(kGridDepthSide);

/// Index of the texel (x, y), which may lie beyond the border: each side of the square is folded at
/// its middle, so the texel beyond it is one within the map.
std::uint32_t texelAt(int x, int y) {
    if (x < 0 || x >= kSide) {
        x = x < 0 ? -1 - x : 2 * kSide - 1 - x;
        y = kSide - 1 - y;
    }
    if (y < 0 || y >= kSide) {
        y = y < 0 ? -1 - y : 2 * kSide - 1 - y;
        x = kSide - 1 - x;
    }
    return std::uint32_t(y * kSide + x);
}

} // namespace

GridDepthLookup gridDepthLookup(glm::vec3 d) {
    const glm::vec2 position = (octahedralSquare(d) * 0.5f + 0.5f) * float(kSide) - 0.5f;
    const glm::vec2 base = glm::floor(position), f = position - base;
    const int x = int(base.x), y = int(base.y);
    return {{texelAt(x, y), texelAt(x + 1, y), texelAt(x, y + 1), texelAt(x + 1, y + 1)},
            {(1 - f.x) * (1 - f.y), f.x * (1 - f.y), (1 - f.x) * f.y, f.x * f.y}};
}

glm::vec3 gridDepthPoint(std::uint32_t texel) {
    return octahedralPoint((glm::vec2(texel % kSide, texel / kSide) + 0.5f) * (2.f / kSide) - 1.f);
}

float gridReach(const Bounds& bounds, glm::uvec3 size) {
    return norm1(bounds.size() / glm::vec3(glm::max(size, glm::uvec3(1))));
}

float seenFromCell(const std::uint16_t* texels, glm::vec3 way, float reach) {
    const float length = norm1(way);
    if (!(length > 0))
        return texels[0] == 0xffff ? 0.f : 1.f;
    float inverse = 0;
    const GridDepthLookup lookup = gridDepthLookup(way);
    for (std::size_t k = 0; k < 4; ++k)
        inverse += lookup.weight[k] * float(texels[lookup.texel[k]]);
    const float share = length * inverse * (kGridDepthScale / 65535 / reach);
    return std::clamp((float(GRID_HIDDEN) - share) * float(GRID_FALLOFF), 0.f, 1.f);
}

} // namespace limn
