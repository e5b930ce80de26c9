// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/chart_places.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// How closely surfels lie on a mesh, relative to other places. Each triangle is parted into cells:
/// 2^level along u and v of its barycentrics; of those along its diagonal half lies in the
/// triangle, those beyond it are never read.
struct MeshDensity {
    std::vector<std::uint8_t> level;  ///< per triangle, [0, kMaxLevel]; empty: one cell in all
    std::vector<std::uint32_t> begin; ///< per triangle: its first cell
    std::vector<float> density = {1}; ///< per cell [surfels per area, relative], > 0

    static constexpr std::uint32_t kMaxLevel = 6;

    bool uniform() const { return level.empty(); }
    std::uint32_t side(std::uint32_t triangle) const {
        return uniform() ? 1 : 1U << level[triangle];
    }
    /// Cell (x, y) of a triangle.
    std::uint32_t cell(std::uint32_t triangle, glm::uvec2 at) const {
        return uniform() ? 0 : begin[triangle] + at.y * side(triangle) + at.x;
    }
    /// The cell (x, y) at barycentrics (u, v).
    glm::uvec2 cellAt(std::uint32_t triangle, glm::vec2 uv) const {
        const std::uint32_t n = side(triangle);
        const glm::uvec2 c(std::min(std::uint32_t(uv.x * float(n)), n - 1),
                           std::min(std::uint32_t(uv.y * float(n)), n - 1));
        return {c.x, std::min(c.y, n - 1 - c.x)};
    }
    float at(std::uint32_t triangle, glm::vec2 uv) const {
        return density[uniform() ? 0 : cell(triangle, cellAt(triangle, uv))];
    }
    /// Share of the triangle's area that cell (x, y) holds.
    double share(std::uint32_t triangle, glm::uvec2 at) const {
        const std::uint32_t n = side(triangle);
        return (at.x + at.y + 1 == n ? 1.0 : 2.0) / (double(n) * n);
    }

    bool operator==(const MeshDensity&) const = default;
};

/// Calls visit(x, y) for each cell that a triangle of 2^level cells a side meets, in rows.
template <class Visit>
void forCells(std::uint32_t side, const Visit& visit) {
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x + y < side; ++x)
            visit(glm::uvec2(x, y));
}

/// What rays of caches met of one mesh, of all its instances together.
struct MeshHits {
    std::vector<MeshPoint> at;
    std::vector<float> weight; ///< of each, > 0
    double area = 0;           ///< of its instances' lit sides in the world [m^2]
};

/// Per mesh the hits' summed weight per area, in powers of sixteen below what most hits meet, and
/// of four below a sixteenth. The density of a cell with few hits is drawn towards its chart's,
/// that towards the mesh's, and that towards the scene's. No mesh has less than half of the scene's
/// density and no cell less than half of its mesh's, so what an object hides stays as it is when
/// the object moves. One density where no mesh was met. `charts` and `shapes` per mesh, as
/// Assets::meshes.
std::vector<MeshDensity> surfelDensities(const Scene& scene, std::span<const MeshCharts> charts,
                                         std::span<const MeshChartShapes> shapes,
                                         std::span<const MeshHits> hits);

/// The range of densityClass().
inline constexpr int kMinDensityClass = -3, kMaxDensityClass = 2;

/// The exponent of a power of sixteen for value / centre: the nearest above 1, and below 1 hardly
/// less than the value deserves. Both > 0; the centre is rounded, so that what changes it little
/// changes no exponent.
int densityClass(double value, double centre);

} // namespace limn
