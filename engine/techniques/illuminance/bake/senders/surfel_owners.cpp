// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/surfel_owners.h"

#include "engine/core/parallel.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/techniques/illuminance/format/surfel_spacing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <glm/geometric.hpp>

namespace limn {

NearestPoint nearestFront(const MeshSurfels& surfels) {
    return {std::span(surfels.position.data(), surfels.frontCount),
            std::span(surfels.normal.data(), surfels.frontCount),
            std::sqrt(std::max(surfels.area, 1e-30f))};
}

bool SurfelOwners::blocksLieWithin(const Mesh& mesh) const {
    bool within = true;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t)
        forCells(m_density.side(t), [&](glm::uvec2 cell) {
            const Block& block = m_blocks[blockOf(t, cell)];
            const std::uint64_t size = std::uint64_t(block.across) * block.up;
            within = within && size > 0 && block.begin + size <= m_owner.size() && block.corner < 3;
        });
    return within;
}

/// Area of the part of the unit square with lower corner (i, j) that lies below the line from
/// (0, up) to (across, 0).
static double areaBelow(double across, double up, double i, double j) {
    // The line's height above the cell's floor falls from `high` to `low`; heights count in [0, 1].
    const double slope = up / across, high = up - slope * i - j, low = high - slope;
    const auto integral = [](double height) {
        return height <= 0 ? 0 : height < 1 ? height * height / 2 : height - 0.5;
    };
    return (integral(high) - integral(low)) / slope;
}

SurfelOwners::Cell SurfelOwners::cellOf(const Block& block, glm::uvec2 densityCell,
                                        std::uint32_t side, std::uint32_t i, std::uint32_t j) {
    // Barycentrics of the triangle's corners.
    constexpr std::array<glm::vec2, 3> kCorners = {glm::vec2(0), glm::vec2(1, 0), glm::vec2(0, 1)};
    const std::size_t corner = side > 1 ? 0 : block.corner;
    const glm::vec2 from = kCorners[corner], u = (kCorners[(corner + 1) % 3] - from) / float(side),
                    v = (kCorners[(corner + 2) % 3] - from) / float(side);
    const glm::dvec2 cells(block.across, block.up);
    Cell cell{block.begin + j * block.across + i,
              from + (float(densityCell.x) + float(double(i) / cells.x)) * u +
                  (float(densityCell.y) + float(double(j) / cells.y)) * v,
              u / float(block.across),
              v / float(block.up),
              0.5f,
              2 / (cells.x * cells.y * side * side)};
    if (isWhole(densityCell, side))
        return cell;
    // How far the triangle reaches beyond `origin`, and how far the cell does, as u + v. Two thirds
    // of the way is the centroid where it is cut to a triangle.
    const double open = 1 - i / cells.x - j / cells.y, reach = 1 / cells.x + 1 / cells.y;
    cell.inside = float(std::min(0.5, 2 * open / (3 * reach)));
    cell.share *= areaBelow(cells.x, cells.y, i, j);
    return cell;
}

/// Corner of a triangle that is opposite to its longest side.
static std::uint32_t oppositeLongestSide(const Mesh& mesh, std::uint32_t triangle) {
    const std::array<std::uint32_t, 3> corner = mesh.triangle(triangle);
    std::array<float, 3> opposite{};
    for (std::size_t k = 0; k < 3; ++k)
        opposite[k] =
            glm::length(mesh.positions[corner[(k + 2) % 3]] - mesh.positions[corner[(k + 1) % 3]]);
    return std::uint32_t(std::ranges::max_element(opposite) - opposite.begin());
}

void SurfelOwners::sizeBlocks(const Mesh& mesh, const MeshSurfels& surfels) {
    // With a quarter of the spacing, the border between two owners is off by an eighth of it at
    // most. With thirds, 48.1 % of a floor's light points lay under a plate that covers 50 % of it;
    // with quarters 49.8 %.
    constexpr float kMaxCells = 1024;
    const MeshDensity& density = surfels.density;
    const double weight = summedWeight(mesh, density) / surfels.frontCount; // of a surfel
    m_density = {density.level, density.begin, {}};
    m_blocks.resize(density.uniform() ? mesh.triangleCount() : density.density.size());
    // Needle-shaped triangles have long sides and almost no area. Their cells must not outnumber
    // all others.
    const double maxInAll = 256.0 * double(surfels.frontCount) + 4.0 * double(mesh.triangleCount());
    double inAll = 0;
    const auto forBlocks = [&](const auto& visit) {
        for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t)
            forCells(density.side(t), [&](glm::uvec2 cell) { visit(t, cell); });
    };
    forBlocks([&](std::uint32_t t, glm::uvec2 cell) {
        const std::uint32_t from = density.side(t) > 1 ? 0 : oppositeLongestSide(mesh, t);
        const std::array<std::uint32_t, 3> corner = mesh.triangle(t);
        const float area = float(weight / double(density.density[density.cell(t, cell)])),
                    spacing = std::sqrt(std::max(area, 1e-30f)) * float(density.side(t));
        const auto cellsAlong = [&](std::uint32_t to) {
            const float length =
                glm::length(mesh.positions[corner[to % 3]] - mesh.positions[corner[from]]);
            return std::uint16_t(
                std::clamp(std::ceil(length / spacing * kCellsPerSpacing - 0.5f), 1.f, kMaxCells));
        };
        Block& block = m_blocks[blockOf(t, cell)];
        block = {0, from, cellsAlong(from + 1), cellsAlong(from + 2)};
        inAll += double(block.across) * block.up;
    });
    const double shrink = std::min(1.0, std::sqrt(maxInAll / inAll));
    std::uint32_t cells = 0;
    forBlocks([&](std::uint32_t t, glm::uvec2 cell) {
        Block& block = m_blocks[blockOf(t, cell)];
        block.across = std::uint16_t(std::max(1.0, block.across * shrink));
        block.up = std::uint16_t(std::max(1.0, block.up * shrink));
        block.begin = cells;
        cells += block.across * block.up;
    });
    m_owner.resize(cells);
}

bool SurfelOwners::isOneCell(std::uint32_t triangle) const {
    if (m_density.side(triangle) > 1)
        return false;
    const Block& block = m_blocks[blockOf(triangle, glm::uvec2(0))];
    return block.across == 1 && block.up == 1;
}

void SurfelOwners::forTriangles(
    const Mesh& mesh, const Progress& progress,
    const std::function<void(std::uint32_t, std::uint32_t)>& visit) const {
    const std::size_t count = mesh.triangleCount(),
                      each = std::clamp<std::size_t>(64 * count / std::max(cells(), 1U), 1, 64);
    parallelRanges((count + each - 1) / each, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end && !progress.cancelled(); ++k)
            visit(std::uint32_t(k * each), std::uint32_t(std::min((k + 1) * each, count)));
    });
}

SurfelOwners::SurfelOwners(const Mesh& mesh, const MeshSurfels& surfels, const Progress& progress)
    : m_frontCount(surfels.frontCount) {
    sizeBlocks(mesh, surfels);
    const NearestPoint nearest = nearestFront(surfels);
    forTriangles(mesh, progress, [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t t = begin; t < end; ++t) {
            const glm::vec3 normal = triangleNormal(mesh, t);
            forCellsOf(t, [&](const Cell& cell) {
                m_owner[cell.index] = nearest.find(trianglePoint(mesh, t, cell.middle()), normal);
            });
        }
    });
}

} // namespace limn
