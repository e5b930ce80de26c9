// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lattice/lattice.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// A convex polygon in the coordinates of a lattice, in which cells are unit cubes.
struct ClippedPolygon {
    /// A triangle that three pairs of planes cut has at most nine corners.
    std::array<glm::vec3, 10> corner;
    std::size_t count = 0;

    void add(glm::vec3 p) {
        if (count < corner.size())
            corner[count++] = p;
    }
};

/// Splits a polygon by the plane where coordinate `axis` is `bound`.
inline void splitPolygon(const ClippedPolygon& polygon, int axis, float bound,
                         ClippedPolygon& below, ClippedPolygon& above) {
    below.count = above.count = 0;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::vec3 p = polygon.corner[i], q = polygon.corner[(i + 1) % polygon.count];
        const float dp = p[axis] - bound, dq = q[axis] - bound;
        (dp < 0 ? below : above).add(p);
        if ((dp < 0) != (dq < 0)) {
            glm::vec3 cut = p + (q - p) * (dp / (dp - dq));
            cut[axis] = bound;
            below.add(cut);
            above.add(cut);
        }
    }
}

/// Calls add(polygon, place) for each part of the polygon that lies in one layer of cells along
/// `axis`; `place` has that layer's number. What lies beyond the lattice belongs to its outer
/// layer.
template <class Add>
void splitByLayers(ClippedPolygon polygon, int axis, std::uint32_t layers, glm::uvec3 place,
                   const Add& add) {
    float lower = polygon.corner[0][axis], upper = lower;
    for (std::size_t i = 1; i < polygon.count; ++i) {
        lower = std::min(lower, polygon.corner[i][axis]);
        upper = std::max(upper, polygon.corner[i][axis]);
    }
    const float last = float(layers - 1);
    const auto end = std::uint32_t(glm::clamp(upper, 0.f, last));
    for (place[axis] = std::uint32_t(glm::clamp(lower, 0.f, last)); place[axis] < end;
         ++place[axis]) {
        ClippedPolygon below, above;
        splitPolygon(polygon, axis, float(place[axis] + 1), below, above);
        if (below.count >= 3)
            add(below, place);
        if (above.count < 3)
            return;
        polygon = above;
    }
    add(polygon, place);
}

/// Clips a triangle in the world to the cells of a lattice. Calls add(cell, middle, area) for each
/// piece, with its middle and area in the world.
template <class Add>
void clipToCells(const Lattice& lattice, const std::array<glm::vec3, 3>& triangle, const Add& add) {
    ClippedPolygon whole;
    for (const glm::vec3 p : triangle)
        whole.add((p - lattice.lower) / lattice.cell);
    const float face = lattice.cell * lattice.cell;
    const auto addPiece = [&](const ClippedPolygon& piece, glm::uvec3 place) {
        float area = 0;
        glm::vec3 middle(0);
        for (std::size_t i = 2; i < piece.count; ++i) {
            const glm::vec3 &a = piece.corner[0], &b = piece.corner[i - 1], &c = piece.corner[i];
            const float part = glm::length(glm::cross(b - a, c - a)) / 2;
            area += part;
            middle += (a + b + c) * (part / 3);
        }
        if (area > 0)
            add(lattice.index(place), lattice.lower + middle / area * lattice.cell, area * face);
    };
    splitByLayers(whole, 2, lattice.size.z, {}, [&](const ClippedPolygon& z, glm::uvec3 inZ) {
        splitByLayers(z, 1, lattice.size.y, inZ, [&](const ClippedPolygon& y, glm::uvec3 inY) {
            splitByLayers(y, 0, lattice.size.x, inY, addPiece);
        });
    });
}

} // namespace limn
