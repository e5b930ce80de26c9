// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/mesh_skin.h"

#include "engine/core/parallel.h"
#include "engine/math/nearest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

namespace {

/// Pieces that share a cache.
struct Cluster {
    double area = 0;
    glm::dvec3 weighted{0}; ///< sum of positions times area
    glm::dvec3 normals{0};  ///< sum of normals times area
    float widest = 0;       ///< angle between a piece's normal and the mean, at most [rad]
    Bounds bounds = kNoBounds;
    glm::ivec3 cube{0};                ///< of the first piece
    std::vector<std::uint32_t> pieces; ///< indices

    glm::vec3 position() const { return glm::vec3(weighted / area); }
    std::optional<glm::vec3> normal() const {
        const double length = glm::length(normals);
        if (!(length > 1e-6 * area))
            return {};
        return glm::vec3(normals / length);
    }
};

float angleBetween(glm::vec3 a, glm::vec3 b) {
    return std::acos(std::clamp(glm::dot(a, b), -1.f, 1.f));
}

/// Distance of the farthest corner of a box.
float farthest(const Bounds& bounds, glm::vec3 p) {
    return glm::length(glm::max(glm::abs(bounds.lower - p), glm::abs(bounds.upper - p)));
}

Cluster clusterOf(std::span<const CubePiece> pieces, std::vector<std::uint32_t> members) {
    Cluster cluster{.cube = pieces[members[0]].cube};
    for (const std::uint32_t i : members) {
        const CubePiece& piece = pieces[i];
        cluster.area += double(piece.area);
        cluster.weighted += glm::dvec3(piece.middle) * double(piece.area);
        cluster.normals += glm::dvec3(piece.normal) * double(piece.area);
        extend(cluster.bounds, piece.bounds);
    }
    if (const auto n = cluster.normal())
        for (const std::uint32_t i : members)
            cluster.widest = std::max(cluster.widest, angleBetween(*n, pieces[i].normal));
    cluster.pieces = std::move(members);
    return cluster;
}

/// Splits the pieces of one cube, indices [begin, end).
void splitCube(std::span<const CubePiece> pieces, std::uint32_t begin, std::uint32_t end,
               float angle, std::vector<Cluster>& clusters) {
    const float minCosine = std::cos(angle) - 1e-6f;
    std::vector<std::uint32_t> left(end - begin);
    for (std::uint32_t i = begin; i < end; ++i)
        left[i - begin] = i;
    while (!left.empty()) {
        std::array<double, kNormalBins> area{};
        std::array<glm::dvec3, kNormalBins> sum{};
        for (const std::uint32_t i : left) {
            const std::uint32_t bin = normalBin(pieces[i].normal);
            area[bin] += double(pieces[i].area);
            sum[bin] += glm::dvec3(pieces[i].normal) * double(pieces[i].area);
        }
        const auto bin = std::uint32_t(std::ranges::max_element(area) - area.begin());
        glm::vec3 middle(glm::normalize(sum[bin]));
        std::uint32_t largest = left[0];
        bool any = false;
        float largestArea = -1;
        for (const std::uint32_t i : left) {
            any |= glm::dot(pieces[i].normal, middle) >= minCosine;
            if (normalBin(pieces[i].normal) == bin && pieces[i].area > largestArea) {
                largest = i;
                largestArea = pieces[i].area;
            }
        }
        if (!any) // an angle far smaller than a bin
            middle = pieces[largest].normal;
        std::vector<std::uint32_t> taken, rest;
        for (const std::uint32_t i : left)
            (glm::dot(pieces[i].normal, middle) >= minCosine ? taken : rest).push_back(i);
        clusters.push_back(clusterOf(pieces, std::move(taken)));
        left = std::move(rest);
    }
}

/// The two clusters as one, where that still fits the spacing.
std::optional<Cluster> joined(const Cluster& a, const Cluster& b, const SkinSpacing& spacing) {
    const auto na = a.normal(), nb = b.normal();
    if (!na || !nb || angleBetween(*na, *nb) > spacing.angle)
        return {};
    Cluster both{.area = a.area + b.area,
                 .weighted = a.weighted + b.weighted,
                 .normals = a.normals + b.normals,
                 .bounds = a.bounds,
                 .cube = a.cube};
    extend(both.bounds, b.bounds);
    const auto n = both.normal();
    // A tenth is left for the way of the cache to its surfaces.
    if (!n || farthest(both.bounds, both.position()) > 0.9f * spacing.distance)
        return {};
    both.widest = std::max(angleBetween(*n, *na) + a.widest, angleBetween(*n, *nb) + b.widest);
    if (both.widest > 2 * spacing.angle)
        return {};
    return both;
}

/// The clusters of each cube, found by its key.
class ClustersByCube {
public:
    explicit ClustersByCube(std::span<const Cluster> clusters) { // ordered by cube
        for (std::uint32_t i = 0; i < clusters.size(); ++i)
            m_keys.emplace_back(cubeKey(clusters[i].cube), i);
    }
    template <class Visit>
    void visit(glm::ivec3 cube, const Visit& visit) const {
        const std::uint64_t key = cubeKey(cube);
        for (auto i = std::ranges::lower_bound(m_keys, std::pair(key, 0U));
             i != m_keys.end() && i->first == key; ++i)
            visit(i->second);
    }

private:
    std::vector<std::pair<std::uint64_t, std::uint32_t>> m_keys;
};

/// Joins clusters of neighbouring cubes: each in turn takes in what it may, from its own cube
/// outwards.
std::vector<Cluster> joinNeighbours(std::vector<Cluster> clusters, const SkinSpacing& spacing) {
    const ClustersByCube byCube(clusters);
    std::vector<bool> taken(clusters.size(), false);
    std::vector<std::uint32_t> asked(clusters.size(), ~0U);
    std::vector<Cluster> result;
    for (std::uint32_t first = 0; first < clusters.size(); ++first) {
        if (taken[first])
            continue;
        taken[first] = true;
        Cluster grown = std::move(clusters[first]);
        std::vector<glm::ivec3> cubes = {grown.cube};
        for (std::size_t next = 0; next < cubes.size(); ++next) {
            const auto offer = [&](std::uint32_t other) {
                if (taken[other] || asked[other] == first)
                    return;
                asked[other] = first;
                std::optional<Cluster> both = joined(grown, clusters[other], spacing);
                if (!both)
                    return;
                taken[other] = true;
                both->pieces = std::move(grown.pieces);
                both->pieces.insert(both->pieces.end(), clusters[other].pieces.begin(),
                                    clusters[other].pieces.end());
                grown = std::move(*both);
                cubes.push_back(clusters[other].cube);
            };
            for (int distance = 0; distance <= 3; ++distance) // faces before edges and corners
                for (int k = 0; k < 27; ++k) {
                    const glm::ivec3 step(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
                    if (std::abs(step.x) + std::abs(step.y) + std::abs(step.z) == distance)
                        byCube.visit(cubes[next] + step, offer);
                }
        }
        result.push_back(std::move(grown));
    }
    return result;
}

/// The cluster's cache, on the nearest of its own surfaces unless that is too far from others.
MeshCache cacheOf(const Mesh& mesh, std::span<const CubePiece> pieces, const Cluster& cluster,
                  float distance) {
    const glm::vec3 mean = cluster.position();
    MeshCache cache{.position = mean,
                    .normal = cluster.normal().value_or(pieces[cluster.pieces[0]].normal)};
    float nearest = std::numeric_limits<float>::infinity();
    TrianglePoint snapped;
    for (const std::uint32_t i : cluster.pieces) {
        const std::array<std::uint32_t, 3> k = mesh.triangle(pieces[i].triangle);
        const TrianglePoint p = nearestOnTriangle(mean, mesh.positions[k[0]], mesh.positions[k[1]],
                                                  mesh.positions[k[2]]);
        if (const float d = glm::distance(p.position, mean); d < nearest) {
            nearest = d;
            snapped = p;
            cache.triangle = pieces[i].triangle;
        }
    }
    cache.u = snapped.u;
    cache.v = snapped.v;
    if (farthest(cluster.bounds, snapped.position) <= distance)
        cache.position = snapped.position;
    return cache;
}

/// Finds caches by place.
class CacheFinder {
public:
    explicit CacheFinder(std::span<const MeshCache> caches) {
        for (const MeshCache& cache : caches) {
            m_positions.push_back(cache.position);
            m_normals.push_back(cache.normal);
        }
        m_tree.emplace(m_positions, m_normals, 0.f); // by distance alone
    }

    NearestCaches listAt(glm::vec3 p, glm::vec3 normal) const {
        NearestCaches list;
        for (const std::size_t asked : {16, 64}) {
            list.cache.fill(NearestCaches::kNone);
            std::size_t count = 0;
            for (const bool facing : {true, false}) {
                nearest(p, normal, asked, [&](std::uint32_t c) {
                    if ((glm::dot(m_normals[c], normal) > 0) == facing)
                        list.cache[count++] = c;
                    return count < NearestCaches::kLength;
                });
                if (facing && count == NearestCaches::kLength)
                    return list;
            }
        }
        return list;
    }

    /// The nearest cache whose normal lies within the angle of that cosine; where there is none,
    /// the nearest.
    std::uint32_t fitting(glm::vec3 p, glm::vec3 normal, float minCosine) const {
        std::uint32_t found = NearestCaches::kNone, first = NearestCaches::kNone;
        for (const std::size_t asked : {1, 8, 64}) {
            nearest(p, normal, asked, [&](std::uint32_t c) {
                if (first == NearestCaches::kNone)
                    first = c;
                if (glm::dot(m_normals[c], normal) < minCosine)
                    return true;
                found = c;
                return false;
            });
            if (found != NearestCaches::kNone)
                return found;
        }
        return first;
    }

private:
    /// Calls visit(cache) for up to 64 nearest caches in order until it returns false.
    template <class Visit>
    void nearest(glm::vec3 p, glm::vec3 normal, std::size_t count, const Visit& visit) const {
        std::array<NearestPoint::Near, 64> near;
        const std::size_t found = m_tree->findSome(p, normal, std::span(near).first(count));
        for (std::size_t i = 0; i < found; ++i)
            if (!visit(near[i].point))
                return;
    }

    std::vector<glm::vec3> m_positions, m_normals;
    std::optional<NearestPoint> m_tree;
};

/// Calls visit(begin, end) for the pieces of each cube.
template <class Visit>
void forEachCube(std::span<const CubePiece> pieces, const Visit& visit) {
    for (std::uint32_t begin = 0; begin < pieces.size();) {
        std::uint32_t end = begin + 1;
        while (end < pieces.size() && pieces[end].cube == pieces[begin].cube)
            ++end;
        visit(begin, end);
        begin = end;
    }
}

/// Makes the cubes with their bins and their lists.
void addCubeLists(std::span<const CubePiece> pieces, const CacheFinder& finder, MeshSkin& skin) {
    std::vector<glm::vec3> middles;
    forEachCube(pieces, [&](std::uint32_t begin, std::uint32_t end) {
        std::array<double, kNormalBins> area{};
        std::array<glm::dvec3, kNormalBins> position{}, normal{};
        for (std::uint32_t i = begin; i < end; ++i) {
            const std::uint32_t bin = normalBin(pieces[i].normal);
            area[bin] += double(pieces[i].area);
            position[bin] += glm::dvec3(pieces[i].middle) * double(pieces[i].area);
            normal[bin] += glm::dvec3(pieces[i].normal) * double(pieces[i].area);
        }
        CubeLists cube{pieces[begin].cube, std::uint32_t(skin.cubeBins.size()), 0};
        for (std::uint32_t bin = 0; bin < kNormalBins; ++bin) {
            if (!(area[bin] > 0))
                continue;
            skin.cubeBins.emplace_back(glm::normalize(normal[bin]));
            middles.emplace_back(position[bin] / area[bin]);
            ++cube.count;
        }
        skin.cubes.push_back(cube);
    });
    skin.lists.resize(middles.size());
    parallelRanges(middles.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            skin.lists[i] = finder.listAt(middles[i], skin.cubeBins[i]);
    });
}

/// Squared distance of a point from a cube.
float distanceToCube(const CubeRaster& raster, glm::ivec3 cube, glm::vec3 p) {
    const glm::vec3 lower = glm::vec3(cube) * raster.edge, upper = lower + raster.edge;
    const glm::vec3 d = glm::max(glm::max(lower - p, p - upper), glm::vec3(0));
    return glm::dot(d, d);
}

} // namespace

MeshSkin skinOf(const Mesh& mesh, const SkinSpacing& spacing, bool twoSided, bool vertexLists) {
    MeshSkin skin;
    skin.raster.edge = spacing.distance / 2;
    const std::vector<CubePiece> pieces = cutIntoCubes(mesh, skin.raster, twoSided);
    if (pieces.empty())
        return skin;
    std::vector<Cluster> clusters;
    forEachCube(pieces, [&](std::uint32_t begin, std::uint32_t end) {
        splitCube(pieces, begin, end, spacing.angle, clusters);
    });
    for (const Cluster& cluster : joinNeighbours(std::move(clusters), spacing))
        skin.caches.push_back(cacheOf(mesh, pieces, cluster, spacing.distance));
    const CacheFinder finder(skin.caches);
    std::vector<double> area(skin.caches.size(), 0);
    for (const CubePiece& piece : pieces)
        area[finder.fitting(piece.middle, piece.normal, std::cos(2 * spacing.angle))] +=
            double(piece.area);
    for (std::size_t c = 0; c < area.size(); ++c)
        skin.caches[c].area = float(area[c]);
    addCubeLists(pieces, finder, skin);
    if (vertexLists)
        for (std::size_t v = 0; v < mesh.positions.size(); ++v)
            skin.vertexLists.push_back(finder.listAt(mesh.positions[v], mesh.normals[v]));
    return skin;
}

const NearestCaches* MeshSkin::find(glm::vec3 position, glm::vec3 normal) const {
    if (cubes.empty())
        return nullptr;
    // Surfaces on a plane between two cubes belong to the one below them.
    const glm::vec3 below = position - normal * (1e-3f * raster.edge);
    const std::uint64_t key = cubeKey(raster.cubeOf(below));
    auto cube = std::ranges::lower_bound(cubes, key, {},
                                         [](const CubeLists& c) { return cubeKey(c.cube); });
    if (cube == cubes.end() || cubeKey(cube->cube) != key)
        cube = std::ranges::min_element(
            cubes, {}, [&](const CubeLists& c) { return distanceToCube(raster, c.cube, below); });
    std::uint32_t best = cube->first;
    for (std::uint32_t i = cube->first + 1; i < cube->first + cube->count; ++i)
        if (glm::dot(cubeBins[i], normal) > glm::dot(cubeBins[best], normal))
            best = i;
    return &lists[best];
}

std::uint64_t MeshSkin::bytes() const {
    return caches.size() * sizeof(MeshCache) + cubes.size() * sizeof(CubeLists) +
           cubeBins.size() * sizeof(glm::vec3) +
           (lists.size() + vertexLists.size()) * sizeof(NearestCaches);
}

} // namespace limn
