// SPDX-License-Identifier: MIT
#include "engine/lightmap/chart_places.h"

#include "engine/core/disjoint_sets.h"
#include "engine/lightmap/atlas.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace limn {

namespace {

std::uint8_t sideOf(glm::vec3 n) {
    const glm::vec3 size = glm::abs(n);
    const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    return std::uint8_t(2 * axis + (n[axis] < 0 ? 1 : 0));
}

glm::vec2 along(int axis, glm::vec3 p) {
    return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

/// Sides shorter than this have one texel, longer ones at least two: one on each edge.
constexpr float kNarrow = 0.125f; // texels

std::uint32_t sideTexels(float texels) {
    constexpr float kLargestSide = 8192;
    const auto steps = std::uint32_t(std::lround(std::min(texels, kLargestSide)));
    return texels < kNarrow ? 1U : std::max(steps, 1U) + 1;
}

/// Sets the place's texel size; `size` is its extent in its plane in object units.
void fitSize(ChartPlace& place, glm::vec2 size, float texelsPerUnit) {
    for (int k = 0; k < 2; ++k) {
        place.size[k] = sideTexels(size[k] * texelsPerUnit);
        place.scale[k] = place.size[k] > 1 ? float(place.size[k] - 1) / size[k] : 0;
    }
}

/// A chart that may share texels with others.
struct Piece {
    std::uint32_t chart;
    glm::ivec2 lower, upper; ///< cells of one texel that its bounds meet
};

/// A cell of one texel in a slab, and a piece that covers it.
struct CellUse {
    std::uint8_t side;
    int slab;
    glm::ivec2 cell;
    std::uint32_t piece;

    auto key() const { return std::tuple(side, slab, cell.y, cell.x, piece); }
    bool sameRow(const CellUse& o) const {
        return side == o.side && slab == o.slab && cell.y == o.cell.y;
    }
};

/// Whether the chart is worth a place of its own.
bool standsAlone(const MeshChartShapes& shapes, const MeshCharts& charts, std::uint32_t chart,
                 float texelsPerUnit) {
    constexpr float kMaxDepth = 2, kMaxCells = 4096;
    constexpr float kMaxOverhead = (1 + kNarrow) / kNarrow; // of a long strip as narrow as that
    const glm::vec2 size = charts.chartSize[chart] * texelsPerUnit;
    if ((size.x + 1) * (size.y + 1) <= kMaxOverhead * size.x * size.y)
        return true;
    const int axis = shapes.side[chart] / 2;
    const glm::vec3 extent = (shapes.upper[chart] - shapes.lower[chart]) * texelsPerUnit;
    const glm::vec2 plane = along(axis, extent) + 1.f;
    return !(extent[axis] <= kMaxDepth && plane.x * plane.y <= kMaxCells);
}

/// Cells covered by the pieces of an instance.
std::vector<CellUse> cellsOf(const MeshChartShapes& shapes, std::span<const Piece> pieces,
                             float texelsPerUnit) {
    std::vector<CellUse> uses;
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
        const std::uint32_t chart = pieces[i].chart;
        const std::uint8_t side = shapes.side[chart];
        const int axis = side / 2;
        const float depth = (shapes.lower[chart][axis] + shapes.upper[chart][axis]) / 2;
        const int slab = int(std::floor(depth * texelsPerUnit));
        for (int y = pieces[i].lower.y; y <= pieces[i].upper.y; ++y)
            for (int x = pieces[i].lower.x; x <= pieces[i].upper.x; ++x)
                uses.push_back({side, slab, {x, y}, i});
    }
    std::sort(uses.begin(), uses.end(),
              [](const CellUse& a, const CellUse& b) { return a.key() < b.key(); });
    return uses;
}

/// Joins pieces in the same cell or in adjacent cells of the same slab.
DisjointSets joinTouching(const std::vector<CellUse>& uses, std::size_t pieces) {
    DisjointSets sets(pieces);
    std::size_t above = 0; // first use of the cell over uses[i]
    for (std::size_t i = 1; i < uses.size(); ++i) {
        const CellUse &u = uses[i], &before = uses[i - 1];
        if (u.sameRow(before) && u.cell.x - before.cell.x <= 1)
            sets.join(u.piece, before.piece);
        const auto upper = std::tuple(u.side, u.slab, u.cell.y - 1, u.cell.x);
        const auto cellOf = [](const CellUse& c) {
            return std::tuple(c.side, c.slab, c.cell.y, c.cell.x);
        };
        while (cellOf(uses[above]) < upper)
            ++above;
        if (cellOf(uses[above]) == upper)
            sets.join(u.piece, uses[above].piece);
    }
    return sets;
}

/// Adds one place per set of touching pieces.
void placePieces(const AtlasInput& in, std::uint32_t instance, float texelsPerUnit, float factor,
                 std::span<const Piece> pieces, std::vector<ChartPlace>& out) {
    const std::uint32_t mesh = in.scene.instances[instance].mesh;
    const MeshChartShapes& shapes = in.shapes[mesh];
    const std::uint32_t sides = sidesOf(in, in.scene.instances[instance]);
    DisjointSets sets = joinTouching(cellsOf(shapes, pieces, texelsPerUnit), pieces.size());
    std::vector<std::uint32_t> placeOf(pieces.size());
    const std::size_t first = out.size();
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
        const std::uint32_t set = sets.find(i); // <= i
        if (set == i) {
            placeOf[i] = std::uint32_t(out.size());
            out.push_back(
                {instance, sides, factor, {}, shapes.side[pieces[i].chart] / 2, {}, {}, {}, {}});
        }
        out[placeOf[set]].charts.push_back(pieces[i].chart);
    }
    for (std::size_t p = first; p < out.size(); ++p) {
        ChartPlace& place = out[p];
        if (place.charts.size() == 1) { // lies flatter in its own plane
            place.axis = -1;
            fitSize(place, in.charts[mesh].chartSize[place.charts[0]], texelsPerUnit);
            continue;
        }
        glm::vec3 lower(1e30f), upper(-1e30f);
        for (const std::uint32_t c : place.charts) {
            lower = glm::min(lower, shapes.lower[c]);
            upper = glm::max(upper, shapes.upper[c]);
        }
        place.lower = along(place.axis, lower);
        fitSize(place, along(place.axis, upper) - place.lower, texelsPerUnit);
    }
}

/// Places the charts of an instance that have this factor.
void placeAlike(const AtlasInput& in, std::uint32_t instance, float texelsPerUnit, float factor,
                std::vector<ChartPlace>& out) {
    const std::uint32_t mesh = in.scene.instances[instance].mesh;
    const MeshChartShapes& shapes = in.shapes[mesh];
    const std::uint32_t sides = sidesOf(in, in.scene.instances[instance]);
    std::vector<Piece> pieces;
    for (std::uint32_t c = 0; c < in.charts[mesh].chartSize.size(); ++c) {
        if (in.factorOf(instance, c) != factor)
            continue;
        if (standsAlone(shapes, in.charts[mesh], c, texelsPerUnit)) {
            out.push_back({instance, sides, factor, {c}, -1, {}, {}, {}, {}});
            fitSize(out.back(), in.charts[mesh].chartSize[c], texelsPerUnit);
            continue;
        }
        const int axis = shapes.side[c] / 2;
        const auto cell = [&](glm::vec3 p) {
            return glm::ivec2(glm::floor(along(axis, p) * texelsPerUnit));
        };
        pieces.push_back({c, cell(shapes.lower[c]), cell(shapes.upper[c])});
    }
    placePieces(in, instance, texelsPerUnit, factor, pieces, out);
}

void placeInstance(const AtlasInput& in, std::uint32_t instance, float texelsPerUnit,
                   std::vector<ChartPlace>& out) {
    std::vector<float> factors = {1};
    if (!in.factor.empty() && !in.factor[instance].empty())
        factors = in.factor[instance];
    std::ranges::sort(factors);
    factors.erase(std::ranges::unique(factors).begin(), factors.end());
    for (const float factor : factors)
        placeAlike(in, instance, texelsPerUnit * factor, factor, out);
}

} // namespace

MeshChartShapes shapesOf(const Mesh& mesh, const MeshCharts& charts) {
    MeshChartShapes result;
    const std::size_t count = charts.chartSize.size();
    result.begin.assign(count + 1, 0);
    for (const std::uint32_t c : charts.chartOfTriangle)
        ++result.begin[c + 1];
    std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
    result.triangles.resize(charts.chartOfTriangle.size());
    result.area.assign(count, 0);
    result.lower.assign(count, glm::vec3(1e30f));
    result.upper.assign(count, glm::vec3(-1e30f));
    std::vector<glm::vec3> facing(count, glm::vec3(0));
    std::vector<std::uint32_t> next(result.begin.begin(), result.begin.end() - 1);
    for (std::uint32_t t = 0; t < charts.chartOfTriangle.size(); ++t) {
        const std::uint32_t c = charts.chartOfTriangle[t];
        result.triangles[next[c]++] = t;
        const float area = triangleArea(mesh, t);
        facing[c] += triangleNormal(mesh, t) * area;
        result.area[c] += double(area);
        for (const std::uint32_t v : mesh.triangle(t)) {
            result.lower[c] = glm::min(result.lower[c], mesh.positions[v]);
            result.upper[c] = glm::max(result.upper[c], mesh.positions[v]);
        }
    }
    for (const glm::vec3 n : facing)
        result.side.push_back(sideOf(n));
    return result;
}

AtlasInput atlasInput(const Scene& scene, const std::vector<MeshCharts>& charts) {
    AtlasInput in{scene, charts, {}, {}, {}};
    for (const Instance& i : scene.instances)
        in.scale.push_back(atlasScale(i));
    for (std::size_t m = 0; m < charts.size(); ++m)
        in.shapes.push_back(shapesOf(scene.assets->meshes[m], charts[m]));
    return in;
}

bool hasLightmap(const AtlasInput& in, const Instance& instance) {
    return !instance.dynamic && !in.charts[instance.mesh].indices.empty();
}

std::uint32_t sidesOf(const AtlasInput& in, const Instance& instance) {
    return isTwoSided(in.scene, instance) ? 2 : 1;
}

glm::vec2 cornerInPlace(const AtlasInput& in, const ChartPlace& place, std::uint32_t triangle,
                        std::uint32_t k) {
    const std::uint32_t mesh = in.scene.instances[place.instance].mesh;
    if (place.axis < 0) {
        const MeshCharts& charts = in.charts[mesh];
        return place.toTexels(charts.chartUv[charts.indices[3 * triangle + k]]);
    }
    const Mesh& m = in.scene.assets->meshes[mesh];
    return place.toTexels(along(place.axis, m.positions[m.indices[3 * triangle + k]]));
}

std::vector<ChartPlace> placeCharts(const AtlasInput& in, float density) {
    std::vector<ChartPlace> places;
    for (std::uint32_t i = 0; i < in.scene.instances.size(); ++i)
        if (hasLightmap(in, in.scene.instances[i]))
            placeInstance(in, i, density * in.scale[i], places);
    return places;
}

} // namespace limn
