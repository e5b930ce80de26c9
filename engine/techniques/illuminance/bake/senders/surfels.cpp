// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/surfels.h"

#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "engine/lightmap/density_fields.h"
#include "engine/lightmap/layout/layout_rules.h"
#include "engine/math/morton.h"
#include "engine/math/sampling.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/scene/mesh/mesh_topology.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/stages/stage_archive.h"
#include "engine/stages/stage_keys.h"
#include "engine/techniques/illuminance/bake/senders/relaxation.h"
#include "engine/techniques/illuminance/format/surfel_spacing.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

namespace limn {

namespace {

bool sendsLight(const Scene& scene, const Instance& instance) {
    return !instance.dynamic && scene.meshOf(instance).triangleCount() > 0;
}

/// World area of the lit sides [m^2], per instance; 0 where no light is sent.
std::vector<double> litAreas(const Scene& scene) {
    std::vector<double> area(scene.instances.size());
    parallelRanges(area.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (sendsLight(scene, scene.instances[i]))
                area[i] = worldArea(scene, scene.instances[i]) *
                          (isTwoSided(scene, scene.instances[i]) ? 2 : 1);
    });
    return area;
}

/// Number of pieces of a mesh that share no vertex position.
std::uint32_t countPieces(const Mesh& mesh) {
    const std::vector<std::uint32_t> point = weldVertices(mesh, false);
    std::uint32_t pieces = point.empty() ? 0 : *std::ranges::max_element(point) + 1;
    std::vector<std::uint32_t> parent(pieces);
    std::iota(parent.begin(), parent.end(), 0U);
    const auto find = [&](std::uint32_t i) {
        while (parent[i] != i)
            i = parent[i] = parent[parent[i]];
        return i;
    };
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const auto [a, b, c] = mesh.triangle(t);
        for (const std::uint32_t other : {b, c})
            if (const std::uint32_t x = find(point[a]), y = find(point[other]); x != y) {
                parent[std::max(x, y)] = std::min(x, y);
                --pieces;
            }
    }
    return std::max(pieces, 1U);
}

/// Minimum number of surfels of each mesh. Emissive meshes are lamps, which by their area alone
/// would get one surfel, with one normal, or none. Caches that see a lamp of side w under less than
/// an eighth of their rays, so from d > 1.1 w, sum over its surfels: with n of them on the side in
/// sight the midpoint rule is off by (w / d)^2 / (12 n) or less in distance, 0.2 % for n = 32. Half
/// of the surfels of a closed lamp face away, hence 64. All lamps together get at most a quarter of
/// `target`.
std::vector<std::uint32_t> minSurfels(const Scene& scene, const std::vector<double>& area,
                                      std::uint32_t target) {
    constexpr std::uint32_t kLampSurfels = 64;
    std::vector<std::uint32_t> required(scene.assets->meshes.size()), users(required.size());
    for (std::size_t i = 0; i < area.size(); ++i)
        if (area[i] > 0) {
            ++users[scene.instances[i].mesh];
            std::uint32_t& n = required[scene.instances[i].mesh]; // 2 marks a lamp
            n = std::max(n, emits(scene.materialOf(scene.instances[i])) ? 2U : 1U);
        }
    std::uint64_t all = 0;
    for (std::size_t m = 0; m < required.size(); ++m)
        if (required[m] > 1) {
            required[m] = kLampSurfels * countPieces(scene.assets->meshes[m]);
            all += std::uint64_t(required[m]) * users[m];
        }
    if (all > target / 4)
        for (std::uint32_t& n : required)
            n = n > 1 ? std::max(1U, std::uint32_t(n * std::uint64_t(target / 4) / all)) : n;
    return required;
}

/// Weight of a cell: its area times its density.
double cellWeight(const Mesh& mesh, const MeshDensity& density, std::uint32_t triangle,
                  glm::uvec2 cell) {
    return triangleArea(mesh, triangle) * density.share(triangle, cell) *
           double(density.density[density.cell(triangle, cell)]);
}

} // namespace

double summedWeight(const Mesh& mesh, const MeshDensity& density) {
    double sum = 0;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t)
        forCells(density.side(t),
                 [&](glm::uvec2 cell) { sum += cellWeight(mesh, density, t, cell); });
    return sum;
}

namespace {

double summedArea(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
        sum += triangleArea(mesh, t);
    return sum;
}

/// Mean density of each mesh over its area.
std::vector<double> meanDensities(const Scene& scene, std::span<const MeshDensity> density) {
    std::vector<double> mean(scene.assets->meshes.size(), 1);
    for (std::size_t m = 0; m < density.size(); ++m)
        if (const double area = summedArea(scene.assets->meshes[m]); area > 0)
            mean[m] = summedWeight(scene.assets->meshes[m], density[m]) / area;
    return mean;
}

/// Whether a mesh needs surfels on both sides: an instance of it that sends light is two-sided.
std::vector<bool> twoSidedMeshes(const Scene& scene) {
    std::vector<bool> both(scene.assets->meshes.size());
    for (const Instance& i : scene.instances)
        if (sendsLight(scene, i) && isTwoSided(scene, i))
            both[i.mesh] = true;
    return both;
}

/// Number of surfels per mesh in proportion to the areas of its instances times its mean density,
/// but at least minSurfels(), which raises some at the expense of the others.
std::vector<std::uint32_t> surfelsPerMesh(const Scene& scene, const std::vector<double>& area,
                                          const std::vector<double>& density,
                                          std::uint32_t target) {
    std::vector<double> sum(scene.assets->meshes.size());
    std::vector<std::uint32_t> users(sum.size()), counts(sum.size());
    for (std::size_t i = 0; i < area.size(); ++i)
        if (area[i] > 0) {
            sum[scene.instances[i].mesh] += area[i] * density[scene.instances[i].mesh];
            ++users[scene.instances[i].mesh];
        }
    const std::vector<std::uint32_t> required = minSurfels(scene, area, target);
    const std::vector<bool> twoSided = twoSidedMeshes(scene);
    const auto sides = [&](std::size_t m) { return twoSided[m] ? 2U : 1U; };
    std::vector<bool> fixed(sum.size());
    for (bool changed = true; changed;) {
        changed = false;
        double total = 0, left = target;
        for (std::size_t m = 0; m < sum.size(); ++m)
            if (fixed[m])
                left -= double(counts[m]) * sides(m) * users[m];
            else
                total += sum[m];
        for (std::size_t m = 0; m < sum.size(); ++m)
            if (users[m] > 0 && !fixed[m]) {
                const double mean = sum[m] / users[m] / sides(m);
                counts[m] = std::uint32_t(std::lround(std::max(left, 0.) * mean / total));
                if (counts[m] < required[m]) {
                    counts[m] = required[m];
                    fixed[m] = changed = true;
                }
            }
    }
    return counts;
}

std::uint64_t hashDensity(const MeshDensity& d, std::uint64_t seed) {
    return hashVector(d.level, hashVector(d.density, seed));
}

/// Marsaglia. Xorshift RNGs. 2003: period 2^32 - 1, the triple 13, 17, 5.
class Xorshift {
public:
    float next() {
        m_state ^= m_state << 13;
        m_state ^= m_state >> 17;
        m_state ^= m_state << 5;
        return unitFloat(m_state);
    }

private:
    std::uint32_t m_state = 2463534242U;
};

/// Maps a point of the unit square to cell `at`; returns barycentrics of the triangle.
glm::vec2 sampleCell(std::uint32_t side, glm::uvec2 cell, glm::vec2 square) {
    if (cell.x + cell.y + 1 == side)
        square = sampleTriangle(square);
    return (glm::vec2(cell) + square) / float(side);
}

/// Point i lies in the cell at (i + 1/2)/count of the summed worth, `total`.
std::vector<MeshPoint> pointsByWeight(const Mesh& mesh, std::uint32_t count,
                                      const MeshDensity& density, double total,
                                      SurfelPlacement placement) {
    std::vector<MeshPoint> points;
    Xorshift random;
    double passed = 0;
    const auto lastTriangle = std::uint32_t(mesh.triangleCount() - 1);
    for (std::uint32_t t = 0; t <= lastTriangle; ++t) {
        const std::uint32_t side = density.side(t);
        forCells(side, [&](glm::uvec2 cell) {
            passed += cellWeight(mesh, density, t, cell);
            const bool last = t == lastTriangle && cell.y + 1 == side;
            while (points.size() < count &&
                   (last || double(points.size()) + 0.5 <= passed / total * count)) {
                const auto i = std::uint32_t(points.size());
                glm::vec2 square(radicalInverse(i + 1, 2), radicalInverse(i + 1, 3));
                if (placement == SurfelPlacement::Random) {
                    square.x = random.next();
                    square.y = random.next();
                }
                points.push_back({t, sampleCell(side, cell, square)});
            }
        });
    }
    return points;
}

/// Areas that follow the density at each point and sum to `total`.
std::vector<float> areasOf(const std::vector<MeshPoint>& points, const MeshDensity& density,
                           double total) {
    std::vector<float> areas;
    double sum = 0;
    for (const MeshPoint& p : points) {
        areas.push_back(1 / density.at(p.triangle, p.barycentric));
        sum += double(areas.back());
    }
    for (float& a : areas)
        a = float(double(a) * total / sum);
    return areas;
}

/// The cofactor matrix stretches a unit patch; the average over the surfels need not equal the
/// triangles' `area` [m^2] where sides stretch differently, so the sum is corrected.
void appendInstance(const Scene& scene, std::uint32_t index, const MeshSurfels& local, double area,
                    Surfels& out) {
    const Instance& instance = scene.instances[index];
    const auto areaOf = [&](std::size_t i) {
        return local.areas.empty() ? local.area : local.areas[i];
    };
    // Another instance of the mesh may be two-sided where this one is not.
    const std::size_t count = isTwoSided(scene, instance) ? local.size() : local.frontCount;
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i)
        sum += double(areaOf(i) * glm::length(instance.normalToWorld * local.normal[i]));
    const double exact = sum > 0 ? area / sum : 1;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 n = instance.normalToWorld * local.normal[i];
        const float stretch = glm::length(n);
        out.position.push_back(instance.toWorld * glm::vec4(local.position[i], 1));
        out.normal.push_back(stretch > 0 ? n / stretch : glm::vec3(0, 1, 0));
        out.area.push_back(std::max(float(double(areaOf(i) * stretch) * exact), kLeastSurfelArea));
        out.instance.push_back(index);
        out.triangle.push_back(local.triangle[i]);
        out.barycentric.push_back(local.barycentric[i]);
    }
}

/// Orders points so that those which follow each other lie close together and face alike: their
/// shadow rays are traced together.
void orderAlongCurve(const Mesh& mesh, std::vector<MeshPoint>& points) {
    constexpr int kBits = 10,
                  kPointsPerCell =
                      64; // of the curve along each axis; of those that are sorted by facing
    const Bounds bounds = boundsOf(mesh.positions);
    const glm::vec3 size = glm::max(bounds.size(), 1e-30f);
    const double cells = std::max(double(points.size()) / kPointsPerCell, 1.0); // on a surface
    const int coarse = std::min(int(std::lround(std::log2(cells) / 2)), kBits);
    std::vector<std::pair<std::uint64_t, MeshPoint>> keyed;
    keyed.reserve(points.size());
    for (const MeshPoint& p : points) {
        const std::uint64_t code =
            mortonCode((trianglePoint(mesh, p.triangle, p.barycentric) - bounds.lower) / size);
        const glm::vec3 n = triangleNormal(mesh, p.triangle);
        const std::uint64_t octant =
            (n.x > 0 ? 4U : 0U) | (n.y > 0 ? 2U : 0U) | (n.z > 0 ? 1U : 0U);
        keyed.emplace_back(
            code >> (3 * (kBits - coarse)) << (3 * kBits + 3) | octant << (3 * kBits) | code, p);
    }
    std::ranges::stable_sort(keyed, {}, &std::pair<std::uint64_t, MeshPoint>::first);
    std::ranges::transform(keyed, points.begin(), [](const auto& k) { return k.second; });
}

} // namespace

MeshSurfels placeSurfels(const Mesh& mesh, std::uint32_t count, bool twoSided,
                         SurfelPlacement placement, MeshDensity density, const Progress& progress) {
    assert(count >= 1 && mesh.triangleCount() >= 1);
    const double total = summedArea(mesh);
    MeshSurfels result;
    result.frontCount = count;
    result.area = float(total / count);
    const double weight = summedWeight(mesh, density);
    std::vector<MeshPoint> points = pointsByWeight(mesh, count, density, weight, placement);
    if (placement == SurfelPlacement::Relaxed)
        relax(mesh, hexagonalSpacing(float(weight / count)), density, points, progress);
    orderAlongCurve(mesh, points);
    if (!density.uniform())
        result.areas = areasOf(points, density, total);
    result.density = std::move(density);
    for (std::uint32_t side = 0; side < (twoSided ? 2 : 1); ++side)
        for (const MeshPoint& p : points) {
            const glm::vec3 normal = triangleNormal(mesh, p.triangle);
            result.position.push_back(trianglePoint(mesh, p.triangle, p.barycentric));
            result.normal.push_back(side == 0 ? normal : -normal);
            result.triangle.push_back(p.triangle);
            result.barycentric.push_back(p.barycentric);
        }
    if (twoSided && !result.areas.empty())
        result.areas.insert(result.areas.end(), result.areas.begin(), result.areas.end());
    return result;
}

template <class A, class S>
static void meshSurfelFields(A& a, S& s, const Mesh& mesh, bool twoSided) {
    const std::uint64_t n = s.position.size();
    a("position", s.position, rule::inReach());
    a("normal", s.normal, rule::count(n), rule::unit());
    a("triangle", s.triangle, rule::count(n));
    a("barycentric", s.barycentric, rule::count(n),
      rule::each("not on the mesh", [&](std::size_t i, glm::vec2 uv) {
          return isPointOf(mesh, {s.triangle[i], uv});
      }));
    a("frontCount", s.frontCount, rule::holds("not the surfels of the front", [=](std::uint32_t f) {
          return f > 0 && n == std::uint64_t(f) * (twoSided ? 2 : 1);
      }));
    a("area", s.area, rule::within(1e-38, 1e30));
    a("areas", s.areas, rule::noneOr(n), rule::within(0, 1e30));
    densityFields(a, s.density, mesh);
}

static MeshSurfels meshSurfels(const Scene& scene, std::size_t m, std::uint32_t count,
                               bool twoSided, const MeshDensity& density, const Progress& progress,
                               StageStore* store) {
    const Mesh& mesh = scene.assets->meshes[m];
    const SurfelPlacement placement = scene.bake.placement;
    const std::uint64_t key = hashValue(std::uint32_t(placement) << 1 | std::uint32_t(twoSided),
                                        hashValue(count, hashDensity(density, hashMesh(mesh))));
    constexpr std::uint32_t kWorthKeeping = 64; // fewer are as fast to place
    return keptOrMade<MeshSurfels>(
        count < kWorthKeeping ? nullptr : store, stageKey(Stage::MeshSurfels, key), progress,
        [&mesh, twoSided](auto& a, auto& s) { meshSurfelFields(a, s, mesh, twoSided); },
        [&] { return placeSurfels(mesh, count, twoSided, placement, density, progress); });
}

SurfelSet placeSurfels(const Scene& scene, std::uint32_t target,
                       std::span<const MeshDensity> density, const Progress& progress,
                       StageStore* store) {
    SurfelSet result;
    const MeshDensity even;
    const auto densityOf = [&](std::size_t m) -> const MeshDensity& {
        return density.empty() ? even : density[m];
    };
    const std::vector<double> area = litAreas(scene);
    const std::vector<std::uint32_t> counts =
        surfelsPerMesh(scene, area, meanDensities(scene, density), target);
    const std::vector<bool> twoSided = twoSidedMeshes(scene);
    result.meshes.resize(counts.size());
    parallelRanges(counts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m)
            if (counts[m] > 0 && !progress.cancelled())
                result.meshes[m] =
                    meshSurfels(scene, m, counts[m], twoSided[m], densityOf(m), progress, store);
    });
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        result.instanceBegin.push_back(std::uint32_t(result.surfels.size()));
        if (sendsLight(scene, scene.instances[i]))
            appendInstance(scene, i, result.meshes[scene.instances[i].mesh], area[i],
                           result.surfels);
    }
    result.instanceBegin.push_back(std::uint32_t(result.surfels.size()));
    return result;
}

std::uint64_t expectedLampSurfels(const Scene& scene, std::uint32_t target) {
    const auto isLamp = [&](const Instance& i) {
        return sendsLight(scene, i) && emits(scene.materialOf(i));
    };
    if (std::ranges::none_of(scene.instances, isLamp))
        return 0;
    const std::vector<std::uint32_t> counts =
        surfelsPerMesh(scene, litAreas(scene), meanDensities(scene, {}), target);
    std::uint64_t sum = 0;
    for (const Instance& i : scene.instances)
        if (isLamp(i))
            sum += std::uint64_t(counts[i.mesh]) * (isTwoSided(scene, i) ? 2 : 1);
    return sum;
}

} // namespace limn
