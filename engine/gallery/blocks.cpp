// SPDX-License-Identifier: MIT
#include "engine/gallery/blocks.h"

#include "engine/gallery/mesh_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace limn {

using glm::dvec3;

/// Grid planes along each axis, in ascending order.
struct Blocks::Grid {
    std::array<std::vector<double>, 3> planes;

    std::size_t cells(int axis) const { return planes[axis].size() - 1; }
    std::size_t cells() const { return cells(0) * cells(1) * cells(2); }
    std::size_t cell(std::array<std::size_t, 3> i) const {
        return (i[2] * cells(1) + i[1]) * cells(0) + i[0];
    }
    dvec3 centre(std::array<std::size_t, 3> i) const {
        dvec3 p;
        for (int k = 0; k < 3; ++k)
            p[k] = (planes[k][i[k]] + planes[k][i[k] + 1]) / 2;
        return p;
    }
};

/// One side of a cell.
struct Blocks::Face {
    std::array<std::size_t, 3> cell; ///< below the face; its upper side along `axis`
    int axis;
    bool up; ///< it looks along +axis
};

static double snapped(double x) {
    return std::floor(x * 8192 + 0.5) / 8192; // as meshes are rounded
}

void Blocks::fill(dvec3 lower, dvec3 upper, int what) {
    m_fills.push_back({lower, upper, what});
}

void Blocks::open(dvec3 lower, dvec3 upper) {
    m_openings.push_back({lower, upper, kOutside});
}

bool Blocks::isIn(const Box& box, dvec3 p) {
    return glm::all(glm::lessThan(box.lower, p)) && glm::all(glm::lessThan(p, box.upper));
}

int Blocks::whatIsAt(dvec3 p) const {
    for (auto box = m_fills.rbegin(); box != m_fills.rend(); ++box)
        if (isIn(*box, p))
            return box->what;
    return kOutside;
}

/// All planes of `edges`, subdivided into steps of at most `spacing`, with one empty cell at either
/// end.
static std::vector<double> planesFrom(std::vector<double> edges, double spacing) {
    for (double& e : edges)
        e = snapped(e);
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<double> planes = {edges.front() - 1};
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        const double gap = edges[i + 1] - edges[i];
        const int steps = std::max(1, int(std::ceil(gap / spacing)));
        for (int k = 0; k < steps; ++k)
            planes.push_back(snapped(edges[i] + gap * k / steps));
    }
    planes.push_back(edges.back());
    planes.push_back(edges.back() + 1);
    return planes;
}

std::vector<Blocks::Face> Blocks::faces(const Grid& grid) const {
    std::vector<int> what(grid.cells());
    std::array<std::size_t, 3> i{};
    const auto forEachCell = [&](auto&& visit) {
        for (i[2] = 0; i[2] < grid.cells(2); ++i[2])
            for (i[1] = 0; i[1] < grid.cells(1); ++i[1])
                for (i[0] = 0; i[0] < grid.cells(0); ++i[0])
                    visit();
    };
    forEachCell([&] { what[grid.cell(i)] = whatIsAt(grid.centre(i)); });
    std::vector<Face> result;
    forEachCell([&] {
        for (int axis = 0; axis < 3; ++axis) {
            std::array<std::size_t, 3> next = i;
            if (++next[axis] >= grid.cells(axis))
                continue;
            const int a = what[grid.cell(i)], b = what[grid.cell(next)];
            if (a == b)
                continue;
            dvec3 middle = grid.centre(i);
            middle[axis] = grid.planes[axis][next[axis]];
            const bool sheet = a != kSolid && b != kSolid;
            if (sheet && std::any_of(m_openings.begin(), m_openings.end(),
                                     [&](const Box& box) { return isIn(box, middle); }))
                continue;
            const bool up = sheet ? b != kOutside && (a == kOutside || b < a) : a == kSolid;
            result.push_back({i, axis, up});
        }
    });
    return result;
}

void Blocks::build(double spacing, const std::function<Mesh&(Facing)>& meshOf) const {
    std::array<std::vector<double>, 3> edges;
    for (const std::vector<Box>* boxes : {&m_fills, &m_openings})
        for (const Box& box : *boxes)
            for (int k = 0; k < 3; ++k)
                edges[k].insert(edges[k].end(), {box.lower[k], box.upper[k]});
    Grid grid;
    std::vector<Face> all;
    for (;; spacing *= 1.5) {
        for (int k = 0; k < 3; ++k)
            grid.planes[k] = planesFrom(edges[k], spacing);
        if (grid.cells() > 400000 && spacing <= 1e6)
            continue;
        all = faces(grid);
        if (all.size() <= kMaxBlockFaces || spacing > 1e6)
            break;
    }
    for (const Face& f : all) {
        const int u = (f.axis + 1) % 3, v = (f.axis + 2) % 3;
        dvec3 p[4];
        for (int corner = 0; corner < 4; ++corner) {
            p[corner][f.axis] = grid.planes[f.axis][f.cell[f.axis] + 1];
            p[corner][u] = grid.planes[u][f.cell[u] + std::size_t(corner == 1 || corner == 2)];
            p[corner][v] = grid.planes[v][f.cell[v] + std::size_t(corner >= 2)];
        }
        if (!f.up)
            std::swap(p[1], p[3]);
        const Facing facing = f.axis != 1 ? Facing::Sideways : f.up ? Facing::Up : Facing::Down;
        addQuad(meshOf(facing), p[0], p[1], p[2], p[3]);
    }
}

} // namespace limn
