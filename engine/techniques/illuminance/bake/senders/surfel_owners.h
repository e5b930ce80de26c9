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

    static constexpr std::uint32_t kAcross = 4, kParts = kAcross * kAcross; ///< of a cell
    struct Place {
        std::uint32_t cell, part; ///< < cells(), < kParts
    };
    /// The place in the table at barycentrics (u, v) of a triangle.
    Place cellAt(std::uint32_t triangle, float u, float v) const {
        const glm::uvec2 densityCell = m_density.cellAt(triangle, {u, v});
        const auto side = float(m_density.side(triangle));
        const Block& block = m_blocks[blockOf(triangle, densityCell)];
        const std::uint32_t n = block.resolution;
        const auto step = [](float x, std::uint32_t steps) { // rounding may leave [0, 1)
            return std::min(std::uint32_t(std::max(x * float(steps), 0.f)), steps - 1);
        };
        const glm::vec2 in = glm::vec2(u, v) * side - glm::vec2(densityCell);
        const std::uint32_t i = step(in.x, n),
                            j = std::min(step(in.y, n), last(densityCell, side, n, i));
        return {block.begin + j * n + i, step(in.y * float(n) - float(j), kAcross) * kAcross +
                                             step(in.x * float(n) - float(i), kAcross)};
    }
    std::uint32_t cells() const { return std::uint32_t(m_owner.size()); }
    /// Calls visit(triangle) for all triangles of the mesh, in parallel, unless cancelled.
    void forTriangles(const Mesh& mesh, const Progress& progress,
                      const std::function<void(std::uint32_t)>& visit) const;

    struct Cell {
        std::uint32_t index;
        glm::vec2 middle; ///< (u, v)
        float side;       ///< along u and v, of the whole cell
        double share; ///< of the triangle's area, where the triangle cuts it less than the whole
    };
    /// Calls visit(Cell) for the cells that meet a triangle; the shares sum to 1.
    template <class Visit>
    void forCellsOf(std::uint32_t triangle, const Visit& visit) const {
        const std::uint32_t side = m_density.side(triangle);
        forCells(side, [&](glm::uvec2 densityCell) {
            const Block& block = m_blocks[blockOf(triangle, densityCell)];
            const std::uint32_t n = block.resolution;
            const double square = 2 / (double(side) * side * n * n);
            const auto width = float(std::sqrt(square / 2));
            for (std::uint32_t j = 0; j < n; ++j)
                for (std::uint32_t i = 0; i < n && j <= last(densityCell, float(side), n, i); ++i) {
                    const glm::vec2 middle = (glm::vec2(float(i), float(j)) + 0.5f) / float(n);
                    const bool cut = densityCell.x + densityCell.y + 1 == side && i + j + 1 == n;
                    visit(Cell{block.begin + j * n + i,
                               (glm::vec2(densityCell) + middle) / float(side), width,
                               cut ? square / 2 : square});
                }
        });
    }
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
    /// The cells in one cell of the density.
    struct Block {
        std::uint32_t begin;
        std::uint32_t resolution; ///< cells along u and v
    };

    std::uint32_t blockOf(std::uint32_t triangle, glm::uvec2 densityCell) const {
        return m_density.uniform() ? triangle : m_density.cell(triangle, densityCell);
    }
    /// The last cell of column i that meets the triangle.
    static std::uint32_t last(glm::uvec2 densityCell, float side, std::uint32_t n,
                              std::uint32_t i) {
        return float(densityCell.x + densityCell.y + 1) < side ? n - 1 : n - 1 - i;
    }
    /// Whether the blocks that are read lie within m_owner.
    bool blocksLieWithin(const Mesh& mesh) const;
    void sizeBlocks(const Mesh& mesh, const MeshSurfels& surfels);

    std::uint32_t m_frontCount = 0;
    MeshDensity m_density;       ///< without its densities: only how triangles are divided
    std::vector<Block> m_blocks; ///< per cell of the density, or triangle where that is uniform
    std::vector<std::uint32_t> m_owner; ///< front surfel per cell
};

} // namespace limn
