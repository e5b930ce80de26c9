// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/chart_places.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// Relative surfel density over a mesh. Each triangle is divided into cells, 2^level along u and v
/// of its barycentrics. Cells on its diagonal lie half inside the triangle; those beyond it are
/// never read.
struct MeshDensity {
    std::vector<std::uint8_t> level;  ///< per triangle, [0, kMaxLevel]; empty: a single cell
    std::vector<std::uint32_t> begin; ///< per triangle: its first cell
    std::vector<float> density = {1}; ///< per cell [surfels per area, relative], > 0

    static constexpr std::uint32_t kMaxLevel = 6;

    bool uniform() const { return level.empty(); }
    std::uint32_t side(std::uint32_t triangle) const {
        return uniform() ? 1 : 1U << level[triangle];
    }
    /// Index of cell (x, y) of a triangle.
    std::uint32_t cell(std::uint32_t triangle, glm::uvec2 c) const {
        return uniform() ? 0 : begin[triangle] + c.y * side(triangle) + c.x;
    }
    /// Cell (x, y) at barycentrics (u, v).
    glm::uvec2 cellAt(std::uint32_t triangle, glm::vec2 uv) const {
        const std::uint32_t n = side(triangle);
        const glm::uvec2 c(std::min(std::uint32_t(uv.x * float(n)), n - 1),
                           std::min(std::uint32_t(uv.y * float(n)), n - 1));
        return {c.x, std::min(c.y, n - 1 - c.x)};
    }
    float at(std::uint32_t triangle, glm::vec2 uv) const {
        return density[uniform() ? 0 : cell(triangle, cellAt(triangle, uv))];
    }
    /// Share of the triangle's area that lies in cell (x, y).
    double share(std::uint32_t triangle, glm::uvec2 c) const {
        const std::uint32_t n = side(triangle);
        return (c.x + c.y + 1 == n ? 1.0 : 2.0) / (double(n) * n);
    }

    bool operator==(const MeshDensity&) const = default;
};

/// Calls visit(x, y), row by row, for each cell inside a triangle with `side` cells per side.
template <class Visit>
void forCells(std::uint32_t side, const Visit& visit) {
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x + y < side; ++x)
            visit(glm::uvec2(x, y));
}

/// Hits of the caches' rays on one mesh, over all its instances.
struct MeshHits {
    std::vector<MeshPoint> points;
    std::vector<float> weight; ///< of each hit, > 0
    double area = 0;           ///< area of its instances' lit sides in the world [m^2]
};

/// Surfel densities per mesh: the summed weight of the hits per area, quantised in powers of
/// sixteen below what most hits meet and of four below a sixteenth. The density of a cell with few
/// hits is blended towards that of its chart, that towards the mesh's, and that towards the
/// scene's. No mesh has less than half of the scene's density and no cell less than half of its
/// mesh's, so the density of hidden surfaces does not change when the objects in front of them
/// move. A mesh without hits has a uniform density. `charts` and `shapes` are per mesh, as
/// Assets::meshes.
std::vector<MeshDensity> surfelDensities(const Scene& scene, std::span<const MeshCharts> charts,
                                         std::span<const MeshChartShapes> shapes,
                                         std::span<const MeshHits> hits);

/// Range of densityClass().
inline constexpr int kMinDensityClass = -3, kMaxDensityClass = 2;

/// Exponent of the power of sixteen for value / centre: rounded to nearest above 1, and rounded up
/// below 1 unless the value is hardly larger. Both > 0. The centre is rounded, so that small
/// changes of it do not change any exponent.
int densityClass(double value, double centre);

/// The least values of all classes but the lowest, in ascending order.
using DensityClassBounds = std::array<double, kMaxDensityClass - kMinDensityClass>;
DensityClassBounds densityClassBounds(double centre);

/// The class of a value that is given by bounds in ascending order.
inline int densityClass(double value, const DensityClassBounds& bounds) {
    int result = kMinDensityClass;
    for (const double bound : bounds)
        result += value >= bound ? 1 : 0;
    return result;
}

} // namespace limn
