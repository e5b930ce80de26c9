// SPDX-License-Identifier: MIT
#include "engine/scene/mesh/closed_surfaces.h"

#include "engine/core/disjoint_sets.h"
#include "engine/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

namespace {

using Meshes = std::span<const Mesh* const>;
using Corners = std::array<glm::dvec3, 3>;

Corners cornersOf(Meshes meshes, ShellTriangle t) {
    const Mesh& mesh = *meshes[t.mesh];
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k)
        corners[k] = glm::dvec3(mesh.positions[mesh.indices[3 * std::size_t(t.triangle) + k]]);
    return corners;
}

/// Triangles whose vertices are numbered by their positions.
struct WeldedTriangles {
    std::vector<ShellTriangle> triangle;
    std::vector<std::array<std::uint32_t, 3>> corner; ///< three different points
};

WeldedTriangles weld(Meshes meshes) {
    struct Vertex {
        glm::vec3 p;
        std::size_t index; // counted over all meshes
    };
    std::vector<Vertex> vertices;
    std::vector<std::size_t> first; // vertex of each mesh
    for (const Mesh* mesh : meshes) {
        first.push_back(vertices.size());
        for (const glm::vec3& p : mesh->positions)
            vertices.push_back({p, vertices.size()});
    }
    std::ranges::sort(vertices, [](const Vertex& a, const Vertex& b) {
        return std::tie(a.p.x, a.p.y, a.p.z) < std::tie(b.p.x, b.p.y, b.p.z);
    });
    std::vector<std::uint32_t> number(vertices.size());
    for (std::size_t i = 0, points = 0; i < vertices.size(); ++i) {
        points += i > 0 && vertices[i].p != vertices[i - 1].p ? 1 : 0;
        number[vertices[i].index] = std::uint32_t(points);
    }
    WeldedTriangles welded;
    for (std::uint32_t m = 0; m < meshes.size(); ++m)
        for (std::uint32_t t = 0; t < meshes[m]->triangleCount(); ++t) {
            std::array<std::uint32_t, 3> corner = meshes[m]->triangle(t);
            for (std::uint32_t& vertex : corner)
                vertex = number[first[m] + vertex];
            if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0])
                continue;
            welded.triangle.push_back({m, t});
            welded.corner.push_back(corner);
        }
    return welded;
}

/// An edge of a triangle.
struct HalfEdge {
    std::uint32_t low, high; ///< points; low < high
    bool up;                 ///< runs from `low` to `high`
    std::uint32_t triangle;

    bool joins(const HalfEdge& other) const { return low == other.low && high == other.high; }
};

std::vector<HalfEdge> sortedEdges(const WeldedTriangles& welded) {
    std::vector<HalfEdge> edges;
    edges.reserve(3 * welded.corner.size());
    for (std::uint32_t t = 0; t < welded.corner.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = welded.corner[t][k], b = welded.corner[t][(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), a < b, t});
        }
    std::ranges::sort(edges, [](const HalfEdge& a, const HalfEdge& b) {
        return std::tie(a.low, a.high, a.triangle, a.up) <
               std::tie(b.low, b.high, b.triangle, b.up);
    });
    return edges;
}

/// Calls visit(edges) for the half-edges of each edge.
template <class Visit>
void forEachEdge(std::span<const HalfEdge> edges, const Visit& visit) {
    for (std::size_t begin = 0; begin < edges.size();) {
        std::size_t end = begin + 1;
        while (end < edges.size() && edges[end].joins(edges[begin]))
            ++end;
        visit(edges.subspan(begin, end - begin));
        begin = end;
    }
}

/// The angle by which a face turns about one of its edges, through the space behind it, until it
/// meets another face of that edge; in (0, 2 pi].
double angleBehind(Meshes meshes, const WeldedTriangles& welded, const HalfEdge& from,
                   const HalfEdge& to) {
    const auto third = [&](const HalfEdge& half) -> std::size_t {
        const std::array<std::uint32_t, 3>& corner = welded.corner[half.triangle];
        return std::size_t(
            std::ranges::find_if(corner,
                                 [&](std::uint32_t c) { return c != half.low && c != half.high; }) -
            corner.begin());
    };
    const Corners a = cornersOf(meshes, welded.triangle[from.triangle]);
    const Corners b = cornersOf(meshes, welded.triangle[to.triangle]);
    const std::size_t tip = third(from);
    const glm::dvec3 start = a[(tip + 1) % 3], along = a[(tip + 2) % 3] - start;
    const glm::dvec3 behind = glm::cross(a[tip] - start, along); // against the front's normal
    const glm::dvec3 outwards = glm::cross(along, behind);       // from the edge into the face
    const glm::dvec3 way = b[third(to)] - start;
    const double angle =
        std::atan2(glm::dot(way, behind) * glm::length(along), glm::dot(way, outwards));
    return angle > 0 ? angle : angle + 2 * std::numbers::pi;
}

/// Calls join(a, b) for triangles that meet in an edge with nothing else between their backs.
template <class Join>
void forEachFold(Meshes meshes, const WeldedTriangles& welded, std::span<const HalfEdge> edge,
                 const Join& join) {
    constexpr std::size_t kMostFaces = 32;
    struct Fold {
        double angle;
        std::size_t up, down; ///< indices into `edge`
    };
    if (edge.size() > kMostFaces)
        return;
    std::vector<Fold> folds;
    for (std::size_t i = 0; i < edge.size(); ++i)
        for (std::size_t k = 0; k < edge.size(); ++k)
            if (edge[i].up && !edge[k].up)
                folds.push_back(
                    {edge.size() == 2 ? 0 : angleBehind(meshes, welded, edge[i], edge[k]), i, k});
    std::ranges::stable_sort(folds, {}, &Fold::angle);
    std::uint64_t taken = 0;
    for (const Fold& fold : folds) {
        const std::uint64_t both = std::uint64_t(1) << fold.up | std::uint64_t(1) << fold.down;
        if ((taken & both) == 0)
            join(edge[fold.up].triangle, edge[fold.down].triangle);
        taken |= (taken & both) == 0 ? both : 0;
    }
}

/// Triangles of each closed shell.
std::vector<std::vector<ShellTriangle>> closedShells(Meshes meshes, const WeldedTriangles& welded) {
    const std::vector<HalfEdge> edges = sortedEdges(welded);
    DisjointSets sets(welded.triangle.size());
    forEachEdge(edges, [&](std::span<const HalfEdge> edge) {
        forEachFold(meshes, welded, edge,
                    [&](std::uint32_t a, std::uint32_t b) { sets.join(a, b); });
    });
    std::vector<bool> open(welded.triangle.size()); // by the shell's first triangle
    std::vector<std::pair<std::uint32_t, int>> balance;
    forEachEdge(edges, [&](std::span<const HalfEdge> edge) {
        balance.clear();
        for (const HalfEdge& half : edge)
            balance.emplace_back(sets.find(half.triangle), half.up ? 1 : -1);
        std::ranges::sort(balance);
        int sum = 0;
        for (std::size_t i = 0; i < balance.size(); ++i) {
            sum += balance[i].second;
            if (i + 1 < balance.size() && balance[i + 1].first == balance[i].first)
                continue;
            if (sum != 0)
                open[balance[i].first] = true;
            sum = 0;
        }
    });
    std::vector<std::vector<ShellTriangle>> shells;
    std::vector<std::uint32_t> shellOf(welded.triangle.size());
    for (std::uint32_t t = 0; t < welded.triangle.size(); ++t) {
        const std::uint32_t first = sets.find(t);
        if (open[first])
            continue;
        if (first == t) {
            shellOf[t] = std::uint32_t(shells.size());
            shells.emplace_back();
        }
        shells[shellOf[first]].push_back(welded.triangle[t]);
    }
    return shells;
}

Bounds boundsOfShell(Meshes meshes, std::span<const ShellTriangle> shell) {
    Bounds bounds = kNoBounds;
    for (const ShellTriangle t : shell)
        for (const std::uint32_t vertex : meshes[t.mesh]->triangle(t.triangle))
            extend(bounds, meshes[t.mesh]->positions[vertex]);
    return bounds;
}

/// Volume behind the shell's front; negative where the front faces inwards.
double signedVolume(Meshes meshes, std::span<const ShellTriangle> shell, glm::dvec3 centre) {
    double sum = 0;
    for (const ShellTriangle t : shell) {
        const auto [a, b, c] = cornersOf(meshes, t);
        sum += glm::dot(a - centre, glm::cross(b - centre, c - centre)) / 6;
    }
    return sum;
}

bool surrounds(const Bounds& outer, const Bounds& inner) {
    for (int k = 0; k < 3; ++k)
        if (!(outer.lower[k] <= inner.lower[k] && inner.upper[k] <= outer.upper[k]))
            return false;
    return true;
}

glm::dvec3 middleOf(const Corners& c) {
    return (c[0] + c[1] + c[2]) / 3.0;
}

/// Half of the solid angle of a triangle seen from the origin, positive from behind its front. Van
/// Oosterom, Strackee. The Solid Angle of a Plane Triangle. 1983
double halfSolidAngle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double volume = glm::dot(a, glm::cross(b, c));
    const double size =
        la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    constexpr double kSmall = 0.1; // up to which four terms of the series are right to 1e-10
    if (!(std::abs(volume) < kSmall * size))
        return volume != 0 ? std::atan2(volume, size) : 0;
    const double t = volume / size, t2 = t * t;
    return t * (1 - t2 * (1 / 3. - t2 * (1 / 5. - t2 / 7)));
}

/// Winding numbers of the shell about `middle` + and - `step`, which is short: triangles far from
/// it beside its length, and beside their size, count as from the middle.
std::array<double, 2> windingBeside(Meshes meshes, std::span<const ShellTriangle> shell,
                                    glm::dvec3 middle, glm::dvec3 step) {
    constexpr double kFarSteps = 100; // steps
    const double steps = kFarSteps * kFarSteps * glm::dot(step, step);
    double before = 0, behind = 0, far = 0;
    for (const ShellTriangle t : shell) {
        auto [a, b, c] = cornersOf(meshes, t);
        a -= middle, b -= middle, c -= middle;
        // |a| above the sum of two sides and kFarSteps steps, by the inequality of means.
        if (glm::dot(a, a) > 3 * (glm::dot(b - a, b - a) + glm::dot(c - a, c - a) + steps)) {
            far += halfSolidAngle(a, b, c);
        } else {
            before += halfSolidAngle(a - step, b - step, c - step);
            behind += halfSolidAngle(a + step, b + step, c + step);
        }
    }
    return {(far + before) / (2 * std::numbers::pi), (far + behind) / (2 * std::numbers::pi)};
}

/// Whether a winding number is one behind the front of the surface.
bool isWoundBehind(const ClosedSurface& surface, double winding) {
    return winding > (surface.isRoom() ? -0.5 : 0.5);
}

/// Whether some triangles of the surface, evenly spread over its list, have their backs behind its
/// front, and their fronts before it.
bool turnsNowhere(Meshes meshes, const ClosedSurface& surface) {
    constexpr std::size_t kLooks = 32;
    constexpr double kDistance = 1e-4; // of a triangle's size
    const std::vector<ShellTriangle>& shell = surface.shell;
    const std::size_t looks = std::min(kLooks, shell.size());
    for (std::size_t i = 0; i < looks; ++i) {
        const Corners c = cornersOf(meshes, shell[i * shell.size() / looks]);
        const glm::dvec3 across = glm::cross(c[1] - c[0], c[2] - c[0]);
        const double area = glm::length(across);
        const double around =
            glm::length(c[1] - c[0]) + glm::length(c[2] - c[1]) + glm::length(c[0] - c[2]);
        if (!(area > 0 && area / around > 0))
            continue;
        const glm::dvec3 step = across / around * kDistance;
        const auto [before, behind] = windingBeside(meshes, surface.shell, middleOf(c), step);
        if (!isWoundBehind(surface, behind) || isWoundBehind(surface, before))
            return false;
    }
    return true;
}

} // namespace

double windingNumber(std::span<const Mesh* const> meshes, std::span<const ShellTriangle> shell,
                     glm::dvec3 point) {
    double sum = 0; // of half solid angles
    for (const ShellTriangle t : shell) {
        const auto [a, b, c] = cornersOf(meshes, t);
        sum += halfSolidAngle(a - point, b - point, c - point);
    }
    return sum / (2 * std::numbers::pi);
}

bool isBehind(std::span<const Mesh* const> meshes, const ClosedSurface& surface, glm::dvec3 point) {
    const Bounds& bounds = surface.bounds;
    for (int k = 0; k < 3; ++k)
        if (!(point[k] > double(bounds.lower[k]) && point[k] < double(bounds.upper[k])))
            return surface.isRoom();
    return isWoundBehind(surface, windingNumber(meshes, surface.shell, point));
}

std::vector<ClosedSurface> findClosedSurfaces(std::span<const Mesh* const> meshes) {
    constexpr double kLeastVolume = 1e-9; // of a cube as wide as the shell; below it is rounding
    std::vector<ClosedSurface> found, inward;
    for (std::vector<ShellTriangle>& shell : closedShells(meshes, weld(meshes))) {
        const Bounds bounds = boundsOfShell(meshes, shell);
        const double volume = signedVolume(meshes, shell, glm::dvec3(bounds.centre()));
        const double width = glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower));
        if (std::abs(volume) > kLeastVolume * width * width * width)
            (volume > 0 ? found : inward).push_back({std::move(shell), bounds, volume});
    }
    const std::size_t solids = found.size();
    for (ClosedSurface& shell : inward) {
        ClosedSurface* around = nullptr;
        const glm::dvec3 place = middleOf(cornersOf(meshes, shell.shell[0]));
        for (std::size_t i = 0; i < solids; ++i)
            if (found[i].volume > -shell.volume && surrounds(found[i].bounds, shell.bounds) &&
                (!around || found[i].volume < around->volume) && isBehind(meshes, found[i], place))
                around = &found[i];
        if (around)
            around->shell.insert(around->shell.end(), shell.shell.begin(), shell.shell.end());
        else
            found.push_back(std::move(shell));
    }
    std::vector<char> sound(found.size());
    parallelRanges(found.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            sound[i] = turnsNowhere(meshes, found[i]) ? 1 : 0;
    });
    std::vector<ClosedSurface> result;
    for (std::size_t i = 0; i < found.size(); ++i)
        if (sound[i] != 0)
            result.push_back(std::move(found[i]));
    return result;
}

} // namespace limn
