// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/occlusion/blocker_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

using Side = BlockerShape::Side;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The triangles of a mesh with vertices at the same place merged.
struct Welded {
    std::vector<glm::vec3> position;
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< those with three distinct vertices
    std::vector<Edge> rim; ///< edges without an opposite; empty: the mesh is closed
    float size = 0;        ///< longest side of its bounding box
};

// Distances, as shares of the size, below which vertices or planes count as the same.
constexpr float kOnePlace = 1e-5f, kOnePlane = 1e-4f;

Bounds boundsOfTriangles(const Mesh& mesh) {
    return boundsOf(mesh.indices |
                    std::views::transform([&](std::uint32_t i) { return mesh.positions[i]; }));
}

void findRim(Welded& w) {
    std::vector<Edge> edges;
    for (const auto& t : w.triangles)
        for (std::size_t i = 0; i < 3; ++i)
            edges.emplace_back(t[i], t[(i + 1) % 3]);
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto [a, b] = edges[i];
        const bool twice = i + 1 < edges.size() && edges[i + 1] == edges[i];
        if (twice || !std::binary_search(edges.begin(), edges.end(), Edge(b, a)))
            w.rim.push_back(edges[i]);
    }
}

Welded weld(const Mesh& mesh, const Bounds& box) {
    Welded w;
    const glm::vec3 size = box.size();
    w.size = std::max({size.x, size.y, size.z});
    std::map<std::tuple<int, int, int>, std::uint32_t> places;
    std::vector<std::uint32_t> place(mesh.positions.size());
    for (std::size_t i = 0; i < place.size(); ++i) {
        const glm::vec3 cell = glm::round((mesh.positions[i] - box.lower) / (kOnePlace * w.size));
        const auto [known, fresh] = places.try_emplace({int(cell.x), int(cell.y), int(cell.z)},
                                                       std::uint32_t(w.position.size()));
        if (fresh)
            w.position.push_back(mesh.positions[i]);
        place[i] = known->second;
    }
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const auto k = mesh.triangle(t);
        const std::array<std::uint32_t, 3> corners = {place[k[0]], place[k[1]], place[k[2]]};
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
            w.triangles.push_back(corners);
    }
    findRim(w);
    return w;
}

/// The plane through `p` as a side with the whole mesh behind it; std::nullopt where the mesh lies
/// on both sides of the plane, or only in it.
std::optional<Side> sideThrough(const Welded& w, glm::vec3 p, glm::vec3 normal) {
    float minHeight = 1e30f, maxHeight = -1e30f;
    for (const glm::vec3 q : w.position) {
        const float height = glm::dot(normal, q - p);
        minHeight = std::min(minHeight, height);
        maxHeight = std::max(maxHeight, height);
    }
    const float near = kOnePlane * w.size;
    if ((maxHeight > near) == (minHeight < -near))
        return std::nullopt;
    if (maxHeight > near)
        normal = -normal;
    return Side{normal, glm::dot(normal, p), true};
}

bool within(const Side& side, glm::vec3 p, float near) {
    return std::abs(glm::dot(side.normal, p) - side.offset) <= near;
}

/// The side that closes a mesh with one side missing.
std::optional<Side> lidOf(const Welded& w) {
    const glm::vec3 p = w.position[w.rim[0].first];
    glm::vec3 normal(0); // twice the area that the rim goes around
    for (const auto& [a, b] : w.rim)
        normal += glm::cross(w.position[a] - p, w.position[b] - p);
    if (!(glm::length(normal) > kOnePlane * w.size * w.size))
        return std::nullopt;
    std::optional<Side> lid = sideThrough(w, p, glm::normalize(normal));
    for (const auto& [a, b] : w.rim)
        if (lid && !within(*lid, w.position[a], kOnePlane * w.size))
            lid.reset();
    if (lid)
        lid->there = false;
    return lid;
}

/// The sides of a convex mesh, one of which may be missing; empty where the mesh is not convex.
std::vector<Side> convexSides(const Welded& w) {
    const float near = kOnePlane * w.size;
    std::vector<Side> sides;
    const auto known = [&](const auto& on) { return std::ranges::any_of(sides, on); };
    for (const auto& t : w.triangles) {
        const glm::vec3 a = w.position[t[0]], b = w.position[t[1]], c = w.position[t[2]];
        if (known([&](const Side& s) {
                return within(s, a, near) && within(s, b, near) && within(s, c, near);
            }))
            continue;
        const glm::vec3 normal = glm::cross(b - a, c - a);
        const std::optional<Side> side =
            glm::length(normal) > 0 ? sideThrough(w, a, glm::normalize(normal)) : std::nullopt;
        if (!side || sides.size() == BlockerShape::kMaxSides)
            return {};
        sides.push_back(*side);
    }
    if (w.rim.empty())
        return sides;
    const std::optional<Side> lid = lidOf(w);
    const bool hole = lid && known([&](const Side& s) {
                          return glm::dot(s.normal, lid->normal) > 0.99f &&
                                 within(s, w.position[w.rim[0].first], near);
                      });
    if (!lid || hole || sides.size() == BlockerShape::kMaxSides)
        return {};
    sides.push_back(*lid);
    return sides;
}

std::vector<Side> boxSides(const Bounds& box) {
    std::vector<Side> sides;
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.f, 1.f}) {
            glm::vec3 normal(0);
            normal[axis] = sign;
            sides.push_back({normal, sign < 0 ? -box.lower[axis] : box.upper[axis], true});
        }
    return sides;
}

/// Squared distance. Ericson. Real-Time Collision Detection. 2005
float distance2(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const auto toEdge = [](glm::vec3 p, glm::vec3 q) {
        const glm::vec3 d = q - p;
        const glm::vec3 near = p + d * std::clamp(-glm::dot(p, d) / glm::dot(d, d), 0.f, 1.f);
        return glm::dot(near, near);
    };
    const glm::vec3 n = glm::cross(b - a, c - a);
    const bool above = glm::dot(glm::cross(b - a, n), a) >= 0 &&
                       glm::dot(glm::cross(c - b, n), b) >= 0 &&
                       glm::dot(glm::cross(a - c, n), c) >= 0;
    const float height = glm::dot(n, a);
    return above && glm::dot(n, n) > 0 ? height * height / glm::dot(n, n)
                                       : std::min({toEdge(a, b), toEdge(b, c), toEdge(c, a)});
}

/// Solid angle seen from 0. Van Oosterom, Strackee. The Solid Angle of a Plane Triangle. 1983
double solidAngle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    return 2 *
           std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                         glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

/// Radius of a ball about `centre` inside all triangles; 0 where the mesh is not closed around it.
float ballWithin(const Welded& w, glm::vec3 centre) {
    if (!w.rim.empty())
        return 0;
    float nearest2 = 1e30f;
    double all = 0;
    for (const auto& t : w.triangles) {
        const glm::vec3 a = w.position[t[0]] - centre, b = w.position[t[1]] - centre,
                        c = w.position[t[2]] - centre;
        nearest2 = std::min(nearest2, distance2(a, b, c));
        all += solidAngle(a, b, c);
    }
    const bool around = std::abs(all) > 2 * std::numbers::pi; // 4 pi, or 0 from outside
    return around ? std::max(0.999f * std::sqrt(nearest2) - 4 * kOnePlace * w.size, 0.f) : 0;
}

} // namespace

BlockerShape blockerShape(const Scene& scene, std::uint32_t mesh) {
    const Mesh& m = scene.assets->meshes[mesh];
    BlockerShape shape;
    shape.box = boundsOfTriangles(m);
    const Welded welded = weld(m, shape.box);
    shape.sides = convexSides(welded);
    if (!shape.sides.empty()) {
        shape.closed = shape.sides.back().there;
        return shape;
    }
    shape.sides = boxSides(shape.box);
    shape.innerBall = ballWithin(welded, shape.box.centre());
    for (const glm::vec3 p : welded.position)
        shape.outerBall = std::max(shape.outerBall, glm::distance(p, shape.box.centre()));
    shape.outerBall += 4 * kOnePlace * welded.size;
    Scene alone;
    alone.assets = scene.assets;
    alone.materials.resize(1);
    alone.instances.resize(1);
    alone.instances[0].mesh = mesh;
    shape.triangles = std::make_unique<const TraceScene>(alone);
    return shape;
}

} // namespace limn
