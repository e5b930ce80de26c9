// SPDX-License-Identifier: MIT
#include "engine/lightmap/charts.h"

#include "engine/lightmap/planar_set.h"
#include "engine/math/sampling.h"
#include "engine/scene/mesh/mesh_topology.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

namespace {

/// Checks periodically whether the bake was cancelled.
struct Stop {
    const Progress& progress;
    bool at(std::size_t i) const { return i % 4096 == 0 && progress.cancelled(); }
};

/// neighbours[begin[t] … begin[t+1]) share an edge with triangle t.
struct Adjacency {
    std::vector<std::uint32_t> begin, neighbours;
};

/// Triangles are adjacent if they share an edge with equal end points.
Adjacency buildAdjacency(const Mesh& mesh, const std::vector<std::uint32_t>& point,
                         const Stop& stop) {
    constexpr std::size_t kMaxSheets = 8; // more share no neighbourhood worth the quadratic walk
    const std::size_t corners = mesh.indices.size() / 3 * 3;
    const auto edge = [&](std::size_t i) {
        return std::minmax(point[mesh.indices[i]], point[mesh.indices[i % 3 == 2 ? i - 2 : i + 1]]);
    };
    // Edges in buckets by their smaller point, sorted by the other point, then by triangle.
    std::vector<std::uint32_t> begin(point.size() + 1, 0);
    for (std::size_t i = 0; i < corners; ++i)
        ++begin[edge(i).first + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sorted(corners); // point, corner
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t i = 0; i < corners && !stop.at(i); ++i) {
        const auto [a, b] = edge(i);
        sorted[next[a]++] = {b, std::uint32_t(i)};
    }
    for (std::size_t a = 0; a + 1 < begin.size() && !stop.at(a); ++a)
        std::sort(sorted.begin() + begin[a], sorted.begin() + begin[a + 1]);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sheets(corners); // range in sorted
    for (std::size_t i = 0, end; i < corners; i = end) {
        const std::uint32_t bucketEnd = begin[edge(sorted[i].second).first + 1];
        for (end = i + 1; end < bucketEnd && sorted[end].first == sorted[i].first; ++end) {
        }
        for (std::size_t k = i; k < end; ++k)
            sheets[sorted[k].second] = {std::uint32_t(i), std::uint32_t(end)};
    }
    Adjacency result;
    result.begin.push_back(0);
    for (std::size_t i = 0; i < corners; ++i) {
        const auto [from, to] = sheets[i];
        for (std::uint32_t k = from; to - from <= kMaxSheets && k < to; ++k)
            if (sorted[k].second / 3 != i / 3)
                result.neighbours.push_back(sorted[k].second / 3);
        if (i % 3 == 2)
            result.begin.push_back(std::uint32_t(result.neighbours.size()));
    }
    return result;
}

/// Grows one chart from `seed`; fills chartOf and the corners' plane coordinates.
class ChartGrower {
public:
    ChartGrower(const Mesh& mesh, const TriangleGeometry& geometry, const Adjacency& adjacency,
                const Stop& stop)
        : m_mesh(mesh), m_geometry(geometry), m_adjacency(adjacency), m_stop(stop),
          chartOf(mesh.triangleCount(), ~0U), corner(mesh.indices.size()) {}

    void grow(std::uint32_t seed, std::uint32_t chart) {
        constexpr float kCosLimit = 0.5f; // 60 degrees: areas shrink to half at most
        const glm::vec3 axis = m_geometry.normal[seed];
        const glm::mat3 basis = basisAround(axis);
        PlanarSet placed(std::sqrt(std::max(m_geometry.area[seed], 1e-30f)) * 2);
        std::vector<std::uint32_t> queue;
        tryAdd(seed, chart, basis, placed, queue);
        for (std::size_t next = 0; next < queue.size() && !m_stop.at(next); ++next)
            for (std::uint32_t i = m_adjacency.begin[queue[next]];
                 i < m_adjacency.begin[queue[next] + 1]; ++i) {
                const std::uint32_t other = m_adjacency.neighbours[i];
                if (chartOf[other] == ~0U && glm::dot(m_geometry.normal[other], axis) > kCosLimit)
                    tryAdd(other, chart, basis, placed, queue);
            }
    }

private:
    void tryAdd(std::uint32_t t, std::uint32_t chart, const glm::mat3& basis, PlanarSet& placed,
                std::vector<std::uint32_t>& queue) {
        Triangle2 flat;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 p = m_mesh.positions[m_mesh.indices[3 * t + k]];
            flat[k] = {glm::dot(basis[0], p), glm::dot(basis[1], p)};
        }
        if (!queue.empty() && placed.overlaps(flat))
            return;
        placed.insert(flat);
        for (std::size_t k = 0; k < 3; ++k)
            corner[3 * t + k] = flat[k];
        chartOf[t] = chart;
        queue.push_back(t);
    }

    const Mesh& m_mesh;
    const TriangleGeometry& m_geometry;
    const Adjacency& m_adjacency;
    const Stop& m_stop;

public:
    std::vector<std::uint32_t> chartOf; ///< per triangle
    std::vector<glm::vec2> corner;      ///< per index
};

/// Makes charts of the islands of TEXCOORD_1, scaled to the surface.
void useAuthoredUv(const Mesh& mesh, const TriangleGeometry& geometry, const Stop& stop,
                   ChartGrower& out) {
    const Adjacency adjacency = buildAdjacency(mesh, weldVertices(mesh, true, stop.progress), stop);
    if (stop.progress.cancelled())
        return;
    double surface = 0, plane = 0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const auto [a, b, c] = mesh.triangle(t);
        const glm::vec2 e1 = mesh.uv1[b] - mesh.uv1[a], e2 = mesh.uv1[c] - mesh.uv1[a];
        surface += geometry.area[t];
        plane += std::abs(e1.x * e2.y - e1.y * e2.x) / 2;
    }
    const float scale = float(std::sqrt(surface / plane));
    for (std::size_t i = 0; i < mesh.indices.size(); ++i)
        out.corner[i] = mesh.uv1[mesh.indices[i]] * scale;
    std::uint32_t charts = 0;
    for (std::uint32_t seed = 0; seed < mesh.triangleCount(); ++seed) {
        if (out.chartOf[seed] != ~0U)
            continue;
        std::vector<std::uint32_t> stack = {seed};
        out.chartOf[seed] = charts;
        while (!stack.empty()) {
            const std::uint32_t t = stack.back();
            stack.pop_back();
            for (std::uint32_t i = adjacency.begin[t]; i < adjacency.begin[t + 1]; ++i)
                if (const std::uint32_t other = adjacency.neighbours[i];
                    out.chartOf[other] == ~0U) {
                    out.chartOf[other] = charts;
                    stack.push_back(other);
                }
        }
        ++charts;
    }
}

void unwrap(const TriangleGeometry& geometry, const Stop& stop, ChartGrower& out) {
    std::vector<std::uint32_t> seeds(geometry.area.size());
    std::iota(seeds.begin(), seeds.end(), 0U);
    std::stable_sort(seeds.begin(), seeds.end(), [&](std::uint32_t a, std::uint32_t b) {
        return geometry.area[a] > geometry.area[b];
    });
    std::uint32_t charts = 0;
    for (std::size_t i = 0; i < seeds.size() && !stop.at(i); ++i)
        if (out.chartOf[seeds[i]] == ~0U)
            out.grow(seeds[i], charts++);
}

} // namespace

MeshCharts splitIntoCharts(const Mesh& mesh, std::vector<std::uint32_t> chartOfTriangle,
                           const std::vector<glm::vec2>& corner) {
    MeshCharts result;
    result.chartOfTriangle = std::move(chartOfTriangle);
    const std::uint32_t charts =
        result.chartOfTriangle.empty()
            ? 0
            : *std::max_element(result.chartOfTriangle.begin(), result.chartOfTriangle.end()) + 1;
    std::vector<glm::vec2> lower(charts, glm::vec2(1e30f)), upper(charts, glm::vec2(-1e30f));
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const std::uint32_t chart = result.chartOfTriangle[i / 3];
        lower[chart] = glm::min(lower[chart], corner[i]);
        upper[chart] = glm::max(upper[chart], corner[i]);
    }
    // Copies of a vertex, one per chart, form chains: the latest copy and the one before each.
    constexpr std::uint32_t kNone = ~0U;
    std::vector<std::uint32_t> latest(mesh.positions.size(), kNone), before, chartOf;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const std::uint32_t chart = result.chartOfTriangle[i / 3], vertex = mesh.indices[i];
        std::uint32_t copy = latest[vertex];
        while (copy != kNone && chartOf[copy] != chart)
            copy = before[copy];
        if (copy == kNone) {
            copy = std::uint32_t(result.sourceVertex.size());
            before.push_back(latest[vertex]);
            chartOf.push_back(chart);
            latest[vertex] = copy;
            result.sourceVertex.push_back(vertex);
            result.chartUv.push_back(corner[i] - lower[chart]);
        }
        result.indices.push_back(copy);
    }
    for (std::uint32_t c = 0; c < charts; ++c)
        result.chartSize.push_back(upper[c] - lower[c]);
    return result;
}

std::string lightmapUvDefect(const Mesh& mesh, const Progress& progress) {
    if (mesh.uv1.empty())
        return "no TEXCOORD_1";
    double total = 0;
    for (const glm::vec2 uv : mesh.uv1)
        if (!(uv.x >= -1e-4f && uv.y >= -1e-4f && uv.x <= 1.0001f && uv.y <= 1.0001f))
            return "TEXCOORD_1 outside [0, 1]";
    PlanarSet placed(1 / std::sqrt(float(mesh.triangleCount()) + 1));
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const auto [a, b, c] = mesh.triangle(t);
        const Triangle2 flat = {mesh.uv1[a], mesh.uv1[b], mesh.uv1[c]};
        const glm::vec2 e1 = flat[1] - flat[0], e2 = flat[2] - flat[0];
        const float area = std::abs(e1.x * e2.y - e1.y * e2.x) / 2;
        if (Stop{progress}.at(t))
            return "cancelled";
        if (!(area > 1e-12f))
            return "TEXCOORD_1 has triangles without area";
        if (placed.overlaps(flat))
            return "TEXCOORD_1 overlaps itself";
        placed.insert(flat);
        total += area;
    }
    return total > 0 ? "" : "TEXCOORD_1 has no area";
}

MeshCharts buildCharts(const Mesh& mesh, const Progress& progress) {
    const Stop stop{progress};
    const TriangleGeometry geometry = triangleGeometry(mesh);
    const bool authored = lightmapUvDefect(mesh, progress).empty();
    const Adjacency adjacency =
        authored ? Adjacency()
                 : buildAdjacency(mesh, weldVertices(mesh, false, stop.progress), stop);
    if (progress.cancelled())
        return {};
    ChartGrower grown(mesh, geometry, adjacency, stop);
    if (authored)
        useAuthoredUv(mesh, geometry, stop, grown);
    else
        unwrap(geometry, stop, grown);
    return progress.cancelled() ? MeshCharts()
                                : splitIntoCharts(mesh, std::move(grown.chartOf), grown.corner);
}

} // namespace limn
