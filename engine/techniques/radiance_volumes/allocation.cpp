// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/allocation.h"

#include "engine/core/parallel.h"
#include "engine/math/sampling.h"
#include "engine/shading/pixel_rays.h"
#include "engine/techniques/radiance_volumes/touched_cells.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr std::size_t kShownPoints = 4096, kShownDropped = 4096;
constexpr glm::uvec3 kNoCell(~0U);
constexpr std::uint32_t kMaxCells = 255; // along a side of a grid over the scene
/// Of a view without a picture.
constexpr float kUsualWidth = 640;

/// What the rays through the middles of a picture's pixels meet, row by row.
struct ViewHits {
    glm::uvec2 size{0};
    std::vector<Hit> hits; ///< no instance: the sky
};

glm::vec3 normalTowardsEye(const Hit& hit) {
    return hit.geometricNormal * (hit.frontFace ? 1.f : -1.f);
}

ViewHits traceView(const TraceScene& trace, const Viewpoint& view, const Progress& progress) {
    ViewHits seen{.size = pictureSize(view)};
    const PixelRays rays(view.camera, seen.size.x, seen.size.y);
    seen.hits.resize(std::size_t(seen.size.x) * seen.size.y);
    parallelRanges(seen.size.y, 1, progress, "view", [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
            for (std::size_t x = 0; x < seen.size.x; ++x)
                seen.hits[y * seen.size.x + x] =
                    trace.closestHit(rays.through(glm::vec2(float(x), float(y)) + 0.5f));
    });
    return seen;
}

/// Calls visit(grid, cell, hit) for the cell of each hit in each grid that lights it, unless the
/// pixel to the left has the same one.
template <class Visit>
void visitCells(const ViewHits& seen, const CacheGrids& grids, const Visit& visit) {
    parallelRanges(seen.size.y, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            std::vector<glm::uvec3> left(grids.grids.size(), kNoCell), here = left;
            for (std::size_t x = 0; x < seen.size.x; ++x) {
                std::swap(left, here);
                std::ranges::fill(here, kNoCell);
                const Hit& hit = seen.hits[y * seen.size.x + x];
                if (!hit)
                    continue;
                const glm::vec3 p = aboveSurface(grids, hit.position, normalTowardsEye(hit));
                const GridShares shares = gridShares(grids, p);
                for (std::size_t k = 0; k < shares.count; ++k) {
                    const std::uint32_t g = shares.share[k].grid;
                    here[g] = grids.grids[g].cellAt(p);
                    if (here[g] != left[g])
                        visit(g, here[g], hit);
                }
            }
        }
    });
}

/// Calls visit(cell, p, normal) for each cell of gridOver() that a triangle touches, with the point
/// of the triangle's plane nearest to the cell's middle.
template <class Visit>
void visitCells(const Scene& scene, const CacheGrid& grid, const Visit& visit) {
    const Lattice cells{grid.lower, grid.cell, grid.nodes - 1U};
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshOf(instance);
        parallelRanges(mesh.triangleCount(), 64, [&](std::size_t begin, std::size_t end) {
            for (auto t = std::uint32_t(begin); t < end; ++t) {
                const auto corners = cornersOf(scene, instance, t);
                const auto k = mesh.triangle(t);
                const glm::vec3 p = mesh.positions[k[0]];
                const glm::vec3 across =
                    instance.normalToWorld *
                    glm::cross(mesh.positions[k[1]] - p, mesh.positions[k[2]] - p);
                const float length = glm::length(across);
                if (length > 0)
                    visitTouchedCells(cells, corners, [&](glm::uvec3 cell) {
                        const glm::vec3 middle = cells.centre(cell), normal = across / length;
                        const float above = glm::dot(middle - corners[0], normal);
                        visit(cell, middle - above * normal, normal);
                    });
            }
        });
    }
}

/// Counts a surface in the places of the caches at the nodes of a cell.
void addSurface(const CacheAllocation& made, std::size_t grid, glm::uvec3 cell, glm::vec3 p,
                glm::vec3 normal, CachePlaceSums& sums) {
    const CacheGrid& g = made.grids.grids[grid];
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const glm::uvec3 node = cellCorner(cell, corner);
        const std::uint32_t cache = made.address[made.grids.firstNode(grid) + g.index(node)];
        if (cache != kNoCache)
            sums.add(cache, g.place(node), g.cell, p, normal);
    }
}

void setPlaces(CacheAllocation& made, const CachePlaceSums& sums) {
    std::size_t cache = 0;
    for (std::size_t g = made.ofGrid.size(); g-- > 0;)
        for (std::size_t k = 0; k < made.ofGrid[g]; ++k, ++cache)
            made.places[cache] =
                placeOf(sums.sums(cache), made.places[cache].position, made.grids.grids[g].cell);
}

WantedNodes nodesOfSurfaces(const Scene& scene, const CacheGrids& grids) {
    WantedNodes wanted(grids.nodes(), 0);
    visitCells(scene, grids.grids[0],
               [&](glm::uvec3 cell, glm::vec3, glm::vec3) { wantNodes(grids, 0, cell, wanted); });
    return wanted;
}

std::size_t countMissed(const CacheAllocation& made, std::span<const Hit> points) {
    std::atomic<std::size_t> missed = 0;
    parallelRanges(points.size(), 256, [&](std::size_t begin, std::size_t end) {
        std::size_t count = 0;
        for (std::size_t i = begin; i < end; ++i)
            count += lookUpCaches(made.grids, made.address, points[i].position,
                                  normalTowardsEye(points[i]))
                                 .count == 0
                         ? 1
                         : 0;
        missed += count;
    });
    return missed;
}

/// One hit of each stretch at random: even steps would show in rows.
std::vector<ShownPoint> someOf(std::span<const Hit> hits, const CacheGrids& grids) {
    std::vector<ShownPoint> points;
    const std::size_t count = std::min(hits.size(), kShownPoints);
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t begin = k * hits.size() / count, end = (k + 1) * hits.size() / count;
        const Hit& hit = hits[begin + mixBits(std::uint32_t(k)) % (end - begin)];
        points.push_back(
            {hit.position, normalTowardsEye(hit),
             gridShares(grids, aboveSurface(grids, hit.position, normalTowardsEye(hit)))
                 .share[0]
                 .grid});
    }
    return points;
}

} // namespace

std::vector<ShownPoint> middlesOfTriangles(const Scene& scene) {
    std::size_t triangles = 0;
    for (const Instance& instance : scene.instances)
        triangles += scene.meshOf(instance).triangleCount();
    const std::size_t step = triangles / kShownPoints + 1;
    std::vector<ShownPoint> points;
    std::size_t number = 0;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshOf(instance);
        for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
            if (number++ % step != 0)
                continue;
            const auto k = mesh.triangle(t);
            const glm::vec3 a = mesh.positions[k[0]], b = mesh.positions[k[1]],
                            c = mesh.positions[k[2]];
            const glm::vec3 n = instance.normalToWorld * glm::cross(b - a, c - a);
            if (glm::length(n) > 0)
                points.push_back({glm::vec3(instance.toWorld * glm::vec4((a + b + c) / 3.f, 1)),
                                  glm::normalize(n), 0});
        }
    }
    return points;
}

glm::uvec2 pictureSize(const Viewpoint& view) {
    if (view.size.x > 0 && view.size.y > 0)
        return view.size;
    return glm::uvec2(kUsualWidth, std::max(kUsualWidth / view.aspect, 1.f));
}

std::size_t CacheAllocation::bytes() const {
    return address.size() * sizeof(std::uint32_t) + places.size() * sizeof(CachePlace);
}

void wantNodes(const CacheGrids& grids, std::size_t grid, glm::uvec3 cell, WantedNodes& wanted) {
    for (std::uint32_t corner = 0; corner < 8; ++corner)
        std::atomic_ref(
            wanted[grids.firstNode(grid) + grids.grids[grid].index(cellCorner(cell, corner))])
            .store(1, std::memory_order_relaxed);
}

CacheAllocation numberCaches(const CacheGrids& grids, const WantedNodes& wanted,
                             std::size_t caches) {
    CacheAllocation made{.grids = grids};
    made.address.assign(grids.nodes(), kNoCache);
    made.ofGrid.assign(grids.grids.size(), 0);
    for (std::size_t g = grids.grids.size(); g-- > 0;) {
        const CacheGrid& grid = grids.grids[g];
        const std::size_t first = grids.firstNode(g);
        for (std::size_t node = 0; node < grid.count(); ++node) {
            if (wanted[first + node] == 0)
                continue;
            const glm::vec3 position = grid.place(grid.node(node));
            if (made.caches() < caches) {
                made.address[first + node] = std::uint32_t(made.caches());
                made.places.push_back({.position = position});
                ++made.ofGrid[g];
            } else if (made.droppedCount++ < kShownDropped) {
                made.dropped.push_back(position);
            }
        }
    }
    return made;
}

CacheAllocation allocateForView(const TraceScene& trace, const Scene& scene, const Viewpoint& view,
                                const VolumeSettings& settings, const Progress& progress) {
    const CacheGrids grids = cascadesAbout(view.camera.eye, scene.bounds, settings.cascades,
                                           settings.nodes, settings.transition);
    if (grids.grids.empty())
        return {};
    ViewHits seen = traceView(trace, view, progress);
    WantedNodes wanted(grids.nodes(), 0);
    visitCells(seen, grids, [&](std::uint32_t g, glm::uvec3 cell, const Hit&) {
        wantNodes(grids, g, cell, wanted);
    });
    CacheAllocation made = numberCaches(grids, wanted, settings.caches);
    CachePlaceSums sums(made.caches());
    visitCells(seen, grids, [&](std::uint32_t g, glm::uvec3 cell, const Hit& hit) {
        addSurface(made, g, cell, hit.position, normalTowardsEye(hit), sums);
    });
    setPlaces(made, sums);
    made.rays = seen.hits.size();
    std::erase_if(seen.hits, [](const Hit& hit) { return !hit; });
    made.pixels = seen.hits.size();
    made.missed = countMissed(made, seen.hits);
    made.shown = someOf(seen.hits, made.grids);
    return made;
}

CacheAllocation allocateForScene(const Scene& scene, const VolumeSettings& settings) {
    std::uint32_t fits = 1, tooFine = kMaxCells + 1;
    if (gridOver(scene.bounds, fits).grids.empty())
        return {};
    while (tooFine - fits > 1) {
        const std::uint32_t cells = (fits + tooFine) / 2;
        const WantedNodes wanted = nodesOfSurfaces(scene, gridOver(scene.bounds, cells));
        (std::size_t(std::ranges::count(wanted, 1)) > settings.caches ? tooFine : fits) = cells;
    }
    const CacheGrids grids = gridOver(scene.bounds, fits);
    CacheAllocation made = numberCaches(grids, nodesOfSurfaces(scene, grids), settings.caches);
    CachePlaceSums sums(made.caches());
    visitCells(scene, grids.grids[0], [&](glm::uvec3 cell, glm::vec3 p, glm::vec3 normal) {
        addSurface(made, 0, cell, p, normal, sums);
    });
    setPlaces(made, sums);
    made.shown = middlesOfTriangles(scene);
    return made;
}

} // namespace limn
