// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/density_fields.h"
#include "engine/math/nearest_point.h"
#include "engine/techniques/illuminance/bake/senders/surfels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace limn {

/// Finds the nearest of a mesh's surfels on front sides. Keeps references to them.
NearestPoint nearestFront(const MeshSurfels& surfels);

/// Whether barycentrics (u, v) are those of a point in the triangle.
inline bool isInTriangle(glm::vec2 uv) {
    return uv.x >= 0 && uv.y >= 0 && uv.x + uv.y <= 1;
}

/// Finds the surfel that stands for a point of a mesh, from tables of triangle cells that hold the
/// nearest surfel of like normal.
class SurfelOwners {
public:
    SurfelOwners() = default;
    /// Meaningless when cancelled.
    SurfelOwners(const Mesh& mesh, const MeshSurfels& surfels, const Progress& progress = {});

    /// Index into the MeshSurfels. Precondition: the mesh has surfels; `back` only on two-sided
    /// ones.
    std::uint32_t surfelAt(std::uint32_t triangle, float u, float v, bool back) const {
        return m_owner[cellAt(triangle, u, v).cell] + (back ? m_frontCount : 0);
    }

    static constexpr float kCellsPerSpacing = 4; ///< along the spacing of surfels
    static constexpr std::uint32_t kAcross = 4, kParts = kAcross * kAcross; ///< of a cell
    struct Place {
        std::uint32_t cell, part; ///< < cells(), < kParts
    };
    /// The place in the table at barycentrics (u, v) of a triangle.
    Place cellAt(std::uint32_t triangle, float u, float v) const {
        const glm::uvec2 densityCell = m_density.cellAt(triangle, {u, v});
        const std::uint32_t side = m_density.side(triangle);
        const Block& block = m_blocks[blockOf(triangle, densityCell)];
        const auto step = [](float x, std::uint32_t steps) { // rounding may leave [0, 1)
            return std::min(std::uint32_t(std::max(x * float(steps), 0.f)), steps - 1);
        };
        const float w = 1 - u - v;
        const glm::vec2 in = side > 1 ? glm::vec2(u, v) * float(side) - glm::vec2(densityCell)
                             : block.corner == 0 ? glm::vec2(u, v)
                             : block.corner == 1 ? glm::vec2(v, w)
                                                 : glm::vec2(w, u);
        const std::uint32_t i = step(in.x, block.across),
                            j = std::min(step(in.y, block.up),
                                         last(block, isWhole(densityCell, side), i));
        return {block.begin + j * block.across + i,
                step(in.y * float(block.up) - float(j), kAcross) * kAcross +
                    step(in.x * float(block.across) - float(i), kAcross)};
    }
    std::uint32_t cells() const { return std::uint32_t(m_owner.size()); }
    /// Calls visit(first, last) for ranges of triangles that cover the mesh, in parallel, unless
    /// cancelled. The ranges are the same for any number of threads.
    void forTriangles(const Mesh& mesh, const Progress& progress,
                      const std::function<void(std::uint32_t, std::uint32_t)>& visit) const;

    /// A cell of the table: a parallelogram in barycentrics (u, v), which may reach beyond the
    /// triangle.
    struct Cell {
        std::uint32_t index;
        glm::vec2 origin, across, up; ///< a corner in the triangle, and the sides from there
        float inside; ///< of the cell's diagonal from `origin`, where the middle of its part in the
                      ///< triangle lies; 1/2: the cell is not cut
        double share; ///< of the triangle's area that lies in the cell

        /// Barycentrics of a place of the cell, whose corners are (0, 0) and (1, 1).
        glm::vec2 at(glm::vec2 place) const { return origin + place.x * across + place.y * up; }
        glm::vec2 middle() const { return at(glm::vec2(inside)); }
    };
    /// Calls visit(Cell) for the cells that meet a triangle; the shares sum to 1.
    template <class Visit>
    void forCellsOf(std::uint32_t triangle, const Visit& visit) const {
        const std::uint32_t side = m_density.side(triangle);
        forCells(side, [&](glm::uvec2 densityCell) {
            const Block& block = m_blocks[blockOf(triangle, densityCell)];
            const bool whole = isWhole(densityCell, side);
            for (std::uint32_t i = 0; i < block.across; ++i)
                for (std::uint32_t j = 0; j <= last(block, whole, i); ++j)
                    visit(cellOf(block, densityCell, side, i, j));
        });
    }
    /// Whether a triangle is smaller than a cell, so that it has one of its own.
    bool isOneCell(std::uint32_t triangle) const;
    std::uint32_t frontCount() const { return m_frontCount; }
    /// The surfel on the front of a cell.
    std::uint32_t front(std::uint32_t cell) const { return m_owner[cell]; }

    /// Lists the tables for an archive.
    template <class A, class T>
    static void fields(A& a, T& o, const Mesh& mesh, const MeshSurfels& surfels) {
        a("frontCount", o.m_frontCount, rule::holds("of other surfels", [&](std::uint32_t n) {
              return n == surfels.frontCount;
          }));
        const bool uniform = surfels.density.uniform();
        partFields(a, o.m_density, mesh, o.m_blocks.size());
        a("blocks", o.m_blocks,
          rule::count(uniform ? mesh.triangleCount() : surfels.density.density.size()),
          rule::holds("out of range", [&](const auto&) { return o.blocksLieWithin(mesh); }));
        a("owner", o.m_owner, rule::below(surfels.frontCount));
    }

private:
    /// How a cell of the density is divided: `across` cells along u and `up` along v. Where it is
    /// a whole triangle, u and v start at its corner `corner`, opposite to the longest side, which
    /// takes the fewest cells.
    struct Block {
        std::uint32_t begin;
        std::uint32_t corner;
        std::uint16_t across, up;
    };

    std::uint32_t blockOf(std::uint32_t triangle, glm::uvec2 densityCell) const {
        return m_density.uniform() ? triangle : m_density.cell(triangle, densityCell);
    }
    /// Whether a cell of the density lies wholly in its triangle, which has `side` along a side.
    static bool isWhole(glm::uvec2 densityCell, std::uint32_t side) {
        return densityCell.x + densityCell.y + 1 < side;
    }
    /// The last cell of column i that meets the triangle.
    static std::uint32_t last(const Block& block, bool whole, std::uint32_t i) {
        return (whole ? block.up
                      : (block.up * (block.across - i) + block.across - 1) / block.across) -
               1;
    }
    static Cell cellOf(const Block& block, glm::uvec2 densityCell, std::uint32_t side,
                       std::uint32_t i, std::uint32_t j);
    /// Whether the blocks that are read lie within m_owner.
    bool blocksLieWithin(const Mesh& mesh) const;
    void sizeBlocks(const Mesh& mesh, const MeshSurfels& surfels);

    std::uint32_t m_frontCount = 0;
    MeshDensity m_density;       ///< without its densities: only how triangles are divided
    std::vector<Block> m_blocks; ///< per cell of the density, or triangle where that is uniform
    std::vector<std::uint32_t> m_owner; ///< front surfel per cell
};

} // namespace limn
