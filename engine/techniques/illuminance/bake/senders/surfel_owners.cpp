// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/surfel_owners.h"

#include "engine/core/parallel.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/techniques/illuminance/format/surfel_spacing.h"

#include <algorithm>
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
            const std::uint64_t n = block.resolution, end = block.begin + n * n;
            within = within && n > 0 && n < (1U << 16) && end <= m_owner.size();
        });
    return within;
}

void SurfelOwners::sizeBlocks(const Mesh& mesh, const MeshSurfels& surfels) {
    // Cells of a third of the surfels' spacing: the border between two owners is off by a sixth of
    // it at most.
    constexpr float kCellsPerSpacing = 3, kMaxCells = 1024;
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
        const auto [a, b, c] = mesh.triangle(t);
        const float longest = std::max(glm::length(mesh.positions[b] - mesh.positions[a]),
                                       glm::length(mesh.positions[c] - mesh.positions[a])),
                    area = float(weight / double(density.density[density.cell(t, cell)])),
                    spacing = std::sqrt(std::max(area, 1e-30f)) * float(density.side(t));
        const float n =
            std::clamp(std::ceil(longest / spacing * kCellsPerSpacing - 0.5f), 1.f, kMaxCells);
        m_blocks[blockOf(t, cell)].resolution = std::uint32_t(n);
        inAll += double(n) * double(n);
    });
    std::uint32_t cells = 0;
    forBlocks([&](std::uint32_t t, glm::uvec2 cell) {
        Block& block = m_blocks[blockOf(t, cell)];
        if (inAll > maxInAll)
            block.resolution =
                std::uint32_t(std::max(1.0, block.resolution * std::sqrt(maxInAll / inAll)));
        block.begin = cells;
        cells += block.resolution * block.resolution;
    });
    m_owner.resize(cells);
}

void SurfelOwners::forTriangles(const Mesh& mesh, const Progress& progress,
                                const std::function<void(std::uint32_t)>& visit) const {
    const std::size_t count = mesh.triangleCount(),
                      grain = std::clamp<std::size_t>(64 * count / std::max(cells(), 1U), 1, 64);
    parallelRanges(count, grain, [&](std::size_t begin, std::size_t end) {
        for (auto t = std::uint32_t(begin); t < end && !progress.cancelled(); ++t)
            visit(t);
    });
}

SurfelOwners::SurfelOwners(const Mesh& mesh, const MeshSurfels& surfels, const Progress& progress)
    : m_frontCount(surfels.frontCount) {
    sizeBlocks(mesh, surfels);
    const NearestPoint nearest = nearestFront(surfels);
    forTriangles(mesh, progress, [&](std::uint32_t t) {
        const glm::vec3 normal = triangleNormal(mesh, t);
        forCellsOf(t, [&](const Cell& cell) {
            glm::vec2 uv = cell.middle;
            if (uv.x + uv.y > 1)
                uv /= uv.x + uv.y;
            m_owner[cell.index] = nearest.find(trianglePoint(mesh, t, uv), normal);
        });
    });
}

} // namespace limn
