// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/surface_cubes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

/// A convex polygon: a triangle cut by the six planes of a cube has nine corners at most.
struct Polygon {
    std::array<glm::dvec3, 12> corner;
    std::size_t count = 0;

    void add(glm::dvec3 p) {
        if (count < corner.size())
            corner[count++] = p;
    }
};

/// What lies on the side of the plane x[axis] = limit where x[axis] is below it, or above it.
Polygon clipped(const Polygon& polygon, int axis, double limit, bool below) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec3 p = polygon.corner[i], q = polygon.corner[(i + 1) % polygon.count];
        const double a = below ? limit - p[axis] : p[axis] - limit;
        const double b = below ? limit - q[axis] : q[axis] - limit;
        if (a >= 0)
            kept.add(p);
        if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
            glm::dvec3 on = p + (q - p) * (a / (a - b));
            on[axis] = limit;
            kept.add(on);
        }
    }
    return kept;
}

/// Cuts a polygon into the slabs of cubes along `axis`, and those along the axes that follow.
/// Surfaces on a plane between two slabs belong to the slab towards which `lean` points.
template <class Add>
void cutAlong(int axis, const Polygon& polygon, double edge, glm::dvec3 lean, glm::ivec3 cube,
              const Add& add) {
    if (polygon.count < 3)
        return;
    if (axis == 3) {
        add(cube, polygon);
        return;
    }
    double lower = polygon.corner[0][axis], upper = lower;
    for (std::size_t i = 1; i < polygon.count; ++i) {
        lower = std::min(lower, polygon.corner[i][axis]);
        upper = std::max(upper, polygon.corner[i][axis]);
    }
    const double nudge = 1e-7 * edge;
    if (upper - lower <= 2 * nudge) {
        // Flat: a place just below the surface decides, so that rounding does not.
        cube[axis] = int(std::floor(((lower + upper) / 2 + lean[axis] * 1e-3 * edge) / edge));
        cutAlong(axis + 1, polygon, edge, lean, cube, add);
        return;
    }
    const int first = int(std::floor((lower + nudge) / edge)),
              last = int(std::floor((upper - nudge) / edge));
    for (int k = first; k <= last; ++k) {
        cube[axis] = k;
        Polygon slab = polygon;
        if (k > first)
            slab = clipped(slab, axis, k * edge, false);
        if (k < last)
            slab = clipped(slab, axis, (k + 1) * edge, true);
        cutAlong(axis + 1, slab, edge, lean, cube, add);
    }
}

CubePiece pieceOf(const Polygon& polygon) {
    CubePiece piece{.bounds = kNoBounds};
    double area = 0;
    glm::dvec3 sum(0);
    const glm::dvec3 a = polygon.corner[0];
    for (std::size_t i = 1; i + 1 < polygon.count; ++i) {
        const glm::dvec3 b = polygon.corner[i], c = polygon.corner[i + 1];
        const double part = glm::length(glm::cross(b - a, c - a)) / 2;
        area += part;
        sum += (a + b + c) * (part / 3);
    }
    for (std::size_t i = 0; i < polygon.count; ++i)
        extend(piece.bounds, glm::vec3(polygon.corner[i]));
    piece.area = float(area);
    if (piece.area > 0)
        piece.middle = glm::vec3(sum / area);
    return piece;
}

} // namespace

glm::ivec3 CubeRaster::cubeOf(glm::vec3 p) const {
    constexpr float kMaximum = float(1 << 20) - 2;
    return glm::ivec3(glm::clamp(glm::floor(p / edge), -kMaximum, kMaximum));
}

std::uint64_t cubeKey(glm::ivec3 cube) {
    constexpr int kOffset = 1 << 20;
    const auto part = [](int i) { return std::uint64_t(std::uint32_t(i + kOffset)) & 0x1fffffU; };
    return part(cube.z) << 42 | part(cube.y) << 21 | part(cube.x);
}

std::vector<CubePiece> cutIntoCubes(const Mesh& mesh, const CubeRaster& raster, bool twoSided) {
    std::vector<CubePiece> pieces;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        const std::array<std::uint32_t, 3> k = mesh.triangle(t);
        Polygon triangle;
        for (const std::uint32_t vertex : k)
            triangle.add(glm::dvec3(mesh.positions[vertex]));
        const glm::dvec3 across = glm::cross(triangle.corner[1] - triangle.corner[0],
                                             triangle.corner[2] - triangle.corner[0]);
        const double length = glm::length(across);
        if (!(length > 0) || !std::isfinite(length))
            continue;
        const glm::dvec3 normal = across / length;
        cutAlong(0, triangle, double(raster.edge), -normal, glm::ivec3(0),
                 [&](glm::ivec3 cube, const Polygon& polygon) {
                     CubePiece piece = pieceOf(polygon);
                     piece.cube = cube;
                     piece.triangle = t;
                     piece.normal = glm::vec3(normal);
                     if (!(piece.area > 0))
                         return;
                     pieces.push_back(piece);
                     if (!twoSided)
                         return;
                     piece.back = true;
                     piece.normal = -piece.normal;
                     pieces.push_back(piece);
                 });
    }
    std::ranges::sort(pieces, [](const CubePiece& a, const CubePiece& b) {
        return std::tuple(cubeKey(a.cube), a.triangle, a.back) <
               std::tuple(cubeKey(b.cube), b.triangle, b.back);
    });
    return pieces;
}

std::uint32_t normalBin(glm::vec3 normal) {
    constexpr float kScale[] = {0, 1, 0.70710678f, 0.57735027f}; // by number of axes
    const glm::vec3 a = glm::abs(normal);
    // Of the directions along one, two or three axes, the nearest has the largest components.
    std::array<int, 3> axis = {0, 1, 2};
    std::ranges::stable_sort(axis, [&](int i, int k) { return a[i] > a[k]; });
    float best = -1, sum = 0;
    int axes = 1;
    for (int count = 1; count <= 3; ++count) {
        sum += a[axis[std::size_t(count - 1)]];
        if (sum * kScale[count] > best) {
            best = sum * kScale[count];
            axes = count;
        }
    }
    std::uint32_t number = 13; // of (0, 0, 0) in a raster of 3 x 3 x 3
    constexpr int kStride[] = {1, 3, 9};
    for (int i = 0; i < axes; ++i) {
        const int k = axis[std::size_t(i)];
        number = std::uint32_t(int(number) + (normal[k] < 0 ? -kStride[k] : kStride[k]));
    }
    return number > 13 ? number - 1 : number;
}

TrianglePoint nearestOnTriangle(glm::vec3 p, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const glm::vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp),
                d4 = glm::dot(ac, bp), d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    const auto point = [&](float u, float v) { return TrianglePoint{a + u * ab + v * ac, u, v}; };
    if (d1 <= 0 && d2 <= 0)
        return point(0, 0);
    if (d3 >= 0 && d4 <= d3)
        return point(1, 0);
    if (d6 >= 0 && d5 <= d6)
        return point(0, 1);
    const float vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0)
        return point(d1 / (d1 - d3), 0);
    if (vb <= 0 && d2 >= 0 && d6 <= 0)
        return point(0, d2 / (d2 - d6));
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const float w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return point(1 - w, w);
    }
    const float sum = va + vb + vc;
    return sum > 0 ? point(vb / sum, vc / sum) : point(0, 0);
}

} // namespace limn
