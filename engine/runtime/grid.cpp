// SPDX-License-Identifier: MIT
#include "engine/runtime/grid.h"

#include <algorithm>
#include <cmath>

namespace limn::runtime {

namespace {

constexpr int kSide = 16;

/// Index of a texel of a depth map, which may lie one beyond the border: there the square is folded
/// at the middle of its sides.
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

float norm1(const float* v) {
    return std::fabs(v[0]) + std::fabs(v[1]) + std::fabs(v[2]);
}

/// The map's bilinear value in direction `way`, which is not 0.
float depthValue(const std::uint16_t* map, const float* way) {
    const float size = norm1(way);
    float x = way[0] / size, y = way[1] / size;
    if (way[2] < 0) {
        const float foldedX = std::copysign(1 - std::fabs(y), way[0]);
        y = std::copysign(1 - std::fabs(x), way[1]);
        x = foldedX;
    }
    const float u = std::clamp((x * 0.5f + 0.5f) * kSide - 0.5f, -0.5f, kSide - 0.5f),
                v = std::clamp((y * 0.5f + 0.5f) * kSide - 0.5f, -0.5f, kSide - 0.5f);
    const float left = std::floor(u), top = std::floor(v), fu = u - left, fv = v - top;
    const int i = int(left), j = int(top);
    return (1 - fu) * (1 - fv) * float(map[texelAt(i, j)]) +
           fu * (1 - fv) * float(map[texelAt(i + 1, j)]) +
           (1 - fu) * fv * float(map[texelAt(i, j + 1)]) +
           fu * fv * float(map[texelAt(i + 1, j + 1)]);
}

/// 1 up to 1.05 times the depth in that direction, falling to 0 at 1.15 times.
float seenFrom(const std::uint16_t* map, const float* way, float reach) {
    const float size = norm1(way);
    if (!(size > 0))
        return map[0] == 0xffff ? 0.f : 1.f;
    constexpr float kScale = 64.f / 65535;
    const float share = size * depthValue(map, way) * (kScale / reach);
    return std::clamp((1.15f - share) * 10, 0.f, 1.f);
}

} // namespace

GridLookup gridLookup(const TransportView& view, const float* position, const float* normal) {
    // If no cell sees the point, all count as if they did; a surface does not hide itself.
    constexpr float kUnseen = 1e-5f, kBias = 0.01f;
    const Space& s = *view.space;
    float cellSize[3], f[3], shortest = 0, reach = 0;
    std::uint32_t base[3];
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t cells = view.dims.grid[k];
        const float extent = s.gridUpper[k] - s.gridLower[k];
        cellSize[k] = extent / float(cells);
        shortest = k == 0 ? cellSize[k] : std::min(shortest, cellSize[k]);
        reach += cellSize[k];
        const float x = std::clamp((position[k] - s.gridLower[k]) / extent * float(cells) - 0.5f,
                                   0.f, float(cells - 1));
        base[k] = std::min(std::uint32_t(x), std::max(cells, 2U) - 2);
        f[k] = x - float(base[k]);
    }
    GridLookup lookup;
    float sum = 0;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        std::uint32_t coordinates[3];
        float way[3], weight = 1;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t step = corner >> k & 1;
            coordinates[k] = std::min(base[k] + step, view.dims.grid[k] - 1);
            weight *= step ? f[k] : 1 - f[k];
            way[k] = position[k] + normal[k] * kBias * shortest -
                     (s.gridLower[k] + (float(coordinates[k]) + 0.5f) * cellSize[k]);
        }
        const std::uint32_t cell =
            (coordinates[2] * view.dims.grid[1] + coordinates[1]) * view.dims.grid[0] +
            coordinates[0];
        const std::uint16_t* map = view.gridDepth + std::size_t(kDepthTexels) * cell;
        lookup.cell[corner] = cell;
        lookup.weight[corner] = weight * (kUnseen + seenFrom(map, way, reach));
        sum += lookup.weight[corner];
    }
    for (float& w : lookup.weight)
        w /= sum;
    return lookup;
}

} // namespace limn::runtime
