// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/relaxation.h"

#include "engine/core/parallel.h"
#include "engine/math/point_grid.h"
#include "engine/math/sampling.h"
#include "engine/techniques/illuminance/bake/senders/surface_walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace limn {

namespace {

// Found by experiment on Cornell and Sponza: even distances and even areas of the points' Voronoi
// cells after ten rounds. From a step of 0.6 on, the points oscillate instead of settling.
constexpr int kRounds = 10;
constexpr float kReach = 1.5f;   // of repulsion [spacings]
constexpr float kStep = 0.45f;   // displacement per force [reaches]
constexpr float kMaxStep = 0.3f; // [reaches]

/// Force at distance d of the reach, in [0, 1].
float repulsion(float d) {
    return (1 - d) * (1 - d);
}

struct Relaxation {
    const SurfaceWalk& walk;
    const Mesh& mesh;
    float reach;
    const PointGrid& grid;
    const std::vector<MeshPoint>& points;
    const std::vector<glm::vec3>& position;

    glm::vec3 fromPoints(std::uint32_t i) const {
        const glm::vec3 p = position[i], n = walk.normal(points[i].triangle);
        glm::vec3 force(0);
        grid.forNear(p, [&](std::uint32_t j) {
            const glm::vec3 d = p - position[j];
            const float d2 = glm::dot(d, d);
            if (j == i || d2 >= reach * reach ||
                glm::dot(n, walk.normal(points[j].triangle)) < -0.1f)
                return;
            const float length = std::sqrt(d2);
            if (length > 0) {
                force += d * (repulsion(length / reach) / length);
            } else { // at the same spot: push apart in any direction
                const float angle = 2 * std::numbers::pi_v<float> * unitFloat(mixBits(i));
                force += basisAround(n) * glm::vec3(std::cos(angle), std::sin(angle), 0);
            }
        });
        return force - n * glm::dot(force, n);
    }

    /// Force from the point's own mirror images behind the borders of its triangle.
    glm::vec3 fromBorders(const MeshPoint& point) const {
        glm::vec3 force(0);
        const std::uint32_t t = point.triangle;
        const float weights[3] = {1 - point.barycentric.x - point.barycentric.y,
                                  point.barycentric.x, point.barycentric.y};
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (!walk.isBorder(t, k))
                continue;
            const glm::vec3 edge = mesh.positions[mesh.indices[3 * t + (k + 1) % 3]] -
                                   mesh.positions[mesh.indices[3 * t + k]];
            const float length = glm::length(edge);
            const float mirrored = 2 * weights[(k + 2) % 3] * 2 * walk.area(t) / length;
            if (mirrored < reach)
                force += glm::cross(walk.normal(t), edge) * (repulsion(mirrored / reach) / length);
        }
        return force;
    }

    MeshPoint moved(std::uint32_t i) const {
        const glm::vec3 force = fromPoints(i) + fromBorders(points[i]);
        const float length = glm::length(force);
        if (!(length > 0))
            return points[i];
        return walk.move(points[i], force * (reach * std::min(kStep, kMaxStep / length)));
    }
};

} // namespace

void relax(const Mesh& mesh, float spacing, const MeshDensity& density,
           std::vector<MeshPoint>& points, const Progress& progress) {
    if (points.size() < 2 || !(spacing > 0) || !std::isfinite(spacing))
        return;
    const SurfaceWalk walk(mesh, progress);
    std::vector<float> densities = density.density;
    std::ranges::sort(densities);
    densities.erase(std::ranges::unique(densities).begin(), densities.end());
    std::vector<glm::vec3> position(points.size());
    std::vector<MeshPoint> next(points.size());
    std::vector<std::vector<std::uint32_t>> alike(densities.size()); // points per density
    PointGrid grid;
    for (int round = 0; round < kRounds && !progress.cancelled(); ++round) {
        for (std::vector<std::uint32_t>& list : alike)
            list.clear();
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            const MeshPoint& p = points[i];
            position[i] = trianglePoint(mesh, p.triangle, p.barycentric);
            const auto lower =
                std::ranges::lower_bound(densities, density.at(p.triangle, p.barycentric));
            alike[std::size_t(lower - densities.begin())].push_back(i);
        }
        for (std::size_t d = 0; d < densities.size(); ++d) {
            if (alike[d].empty())
                continue;
            const float reach = kReach * spacing / std::sqrt(densities[d]);
            grid.build(position, reach);
            const Relaxation step{walk, mesh, reach, grid, points, position};
            parallelRanges(alike[d].size(), 256, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i)
                    next[alike[d][i]] = step.moved(alike[d][i]);
            });
        }
        points.swap(next);
    }
}

} // namespace limn
