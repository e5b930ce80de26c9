// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/probe_places.h"

#include "engine/core/parallel.h"
#include "engine/lattice/lattice.h"
#include "engine/math/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr std::array<glm::ivec3, 6> kSides = {glm::ivec3(1, 0, 0),  glm::ivec3(0, 1, 0),
                                              glm::ivec3(0, 0, 1),  glm::ivec3(-1, 0, 0),
                                              glm::ivec3(0, -1, 0), glm::ivec3(0, 0, -1)};

constexpr std::uint32_t kSolid = ~0U; ///< a cell that no air has reached
constexpr float kMaxBacks = 0.25f;    ///< share of the view from open air

bool isInside(const Lattice& lattice, glm::ivec3 c) {
    return c.x >= 0 && c.y >= 0 && c.z >= 0 && c.x < int(lattice.size.x) &&
           c.y < int(lattice.size.y) && c.z < int(lattice.size.z);
}

/// Calls visit(neighbour, side) for the cells next to a cell.
template <class Visit>
void forNeighbours(const Lattice& lattice, std::uint32_t cell, const Visit& visit) {
    for (std::size_t side = 0; side < kSides.size(); ++side)
        if (const glm::ivec3 next = glm::ivec3(lattice.place(cell)) + kSides[side];
            isInside(lattice, next))
            visit(lattice.index(glm::uvec3(next)), side);
}

/// Per cell, for each of the first three of kSides: a surface lies between it and the next one.
std::vector<std::array<std::uint8_t, 3>> findWalls(const TraceScene& trace, const Lattice& lattice,
                                                   const Progress& progress) {
    std::vector<std::array<std::uint8_t, 3>> walls(lattice.cells(), {0, 0, 0});
    parallelRanges(walls.size(), 256, progress, "probes", [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            for (std::size_t side = 0; side < 3; ++side) {
                const glm::uvec3 cell = lattice.place(std::uint32_t(c));
                const glm::ivec3 next = glm::ivec3(cell) + kSides[side];
                if (isInside(lattice, next))
                    walls[c][side] = trace.blocked(
                        lattice.centre(cell), lattice.centre(glm::uvec3(next)), TraceMask::Static);
            }
    });
    return walls;
}

/// Calls look(cell) for each cell whose middle a receiver sees, of the eight around the receiver.
template <class Look>
void forSeenCells(const TraceScene& trace, const Lattice& lattice,
                  std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                  const std::vector<std::uint32_t>& airOf, const Look& look) {
    for (std::size_t r = 0; r < positions.size(); ++r) {
        const glm::vec3 from = trace.clearOf(positions[r], normals[r]);
        const glm::ivec3 corner(glm::floor((from - lattice.lower) / lattice.cell - 0.5f));
        for (int k = 0; k < 8; ++k) {
            const glm::ivec3 cell = corner + glm::ivec3(k & 1, k >> 1 & 1, k >> 2);
            if (!isInside(lattice, cell) || airOf[lattice.index(glm::uvec3(cell))] != kSolid)
                continue;
            const glm::vec3 middle = lattice.centre(glm::uvec3(cell));
            if (glm::dot(middle - from, normals[r]) > 0 &&
                !trace.blocked(from, middle, TraceMask::Static))
                look(lattice.index(glm::uvec3(cell)));
        }
    }
}

/// Share of the view from a point that is backs of one-sided surfaces.
float backsSeen(const TraceScene& trace, glm::vec3 from) {
    constexpr std::uint32_t kLooks = 32;
    const DirectionSet directions(kLooks, true, 0);
    const Scene& scene = trace.scene();
    float seen = 0;
    for (std::uint32_t i = 0; i < kLooks; ++i)
        if (const Hit hit = trace.closestHit({from, directions[i]}, TraceMask::Static);
            hit && !hit.frontFace && !isTwoSided(scene.materialOf(scene.instances[hit.instance])))
            seen += 1.f / kLooks;
    return seen;
}

} // namespace

OpenAir findOpenAir(const TraceScene& trace, std::span<const glm::vec3> positions,
                    std::span<const glm::vec3> normals, std::uint32_t cells,
                    const Progress& progress) {
    Bounds bounds = staticBounds(trace.scene());
    const glm::vec3 size = bounds.size();
    const float margin = std::max({size.x, size.y, size.z}) / float(cells);
    bounds.lower -= margin;
    bounds.upper += margin;
    const Lattice lattice = latticeOver(bounds, cells + 2);
    const auto walls = findWalls(trace, lattice, progress);
    const auto isWall = [&](std::uint32_t cell, std::uint32_t next, std::size_t side) {
        return walls[side < 3 ? cell : next][side % 3] != 0;
    };
    std::vector<std::uint32_t> airOf(lattice.cells(), kSolid); // number of the connected air
    std::vector<std::uint32_t> open;                           // cells
    std::uint32_t airs = 0;
    forSeenCells(trace, lattice, positions, normals, airOf, [&](std::uint32_t first) {
        std::size_t next = open.size();
        airOf[first] = airs;
        for (open.push_back(first); next < open.size(); ++next)
            forNeighbours(lattice, open[next], [&](std::uint32_t other, std::size_t side) {
                if (airOf[other] != kSolid || isWall(open[next], other, side))
                    return;
                airOf[other] = airs;
                open.push_back(other);
            });
        ++airs;
    });
    std::ranges::sort(open);
    std::vector<std::uint32_t> beside;
    for (const std::uint32_t cell : open) {
        bool atWall = false;
        forNeighbours(lattice, cell, [&](std::uint32_t other, std::size_t side) {
            atWall |= isWall(cell, other, side);
        });
        if (atWall)
            beside.push_back(cell);
    }
    std::vector<float> backs(beside.size());
    parallelRanges(beside.size(), 64, progress, "probes", [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            backs[i] = backsSeen(trace, lattice.centre(lattice.place(beside[i])));
    });
    std::vector<double> sum(airs, 0), count(airs, 0);
    for (std::size_t i = 0; i < beside.size(); ++i) {
        sum[airOf[beside[i]]] += double(backs[i]);
        count[airOf[beside[i]]] += 1;
    }
    const auto isOpen = [&](std::uint32_t cell) {
        return sum[airOf[cell]] <= double(kMaxBacks) * count[airOf[cell]];
    };
    OpenAir air;
    air.volume = double(std::ranges::count_if(open, isOpen)) * std::pow(double(lattice.cell), 3);
    for (std::size_t i = 0; i < beside.size(); ++i)
        if (isOpen(beside[i]) && backs[i] <= kMaxBacks)
            air.besideSurfaces.push_back(lattice.centre(lattice.place(beside[i])));
    return air;
}

std::vector<glm::vec3> removeDensest(std::vector<glm::vec3> points, float radius,
                                     std::size_t left) {
    constexpr float kRounding = 1e-4f;
    std::vector<float> density(points.size(), 0);
    const auto share = [&](std::size_t i, std::size_t k) {
        return probeFalloff(glm::distance(points[i], points[k]) / radius);
    };
    parallelRanges(points.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t k = 0; k < points.size(); ++k)
                density[i] += share(i, k);
    });
    while (points.size() > left) {
        const float threshold = *std::ranges::max_element(density) * (1 - kRounding);
        std::size_t densest = points.size() - 1;
        while (density[densest] < threshold)
            --densest;
        for (std::size_t i = 0; i < points.size(); ++i)
            density[i] -= share(i, densest);
        points.erase(points.begin() + std::ptrdiff_t(densest));
        density.erase(density.begin() + std::ptrdiff_t(densest));
    }
    return points;
}

std::vector<glm::vec3> placeProbes(const OpenAir& air, std::uint32_t wanted) {
    const auto spacing = [&](double probes) {
        return std::cbrt(air.volume) / (std::cbrt(std::max(probes, 2.)) - 1);
    };
    const double last = spacing(wanted);
    std::vector<glm::vec3> probes = air.besideSurfaces;
    for (const double rho : {last / 4, last / 2, last}) {
        const double kept = std::pow(1 + std::cbrt(air.volume) / rho, 3);
        probes = removeDensest(std::move(probes), float(rho),
                               std::max(std::size_t(std::llround(kept)), std::size_t(wanted)));
    }
    return probes;
}

} // namespace limn
