// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/cut_mesh.h"

#include "engine/lightmap/charts.h"
#include "engine/scene/mesh/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <type_traits>
#include <unordered_map>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

/// Points closer to a cut, an edge or each other than this part of a triangle's size lie on it.
constexpr double kTiny = 1e-6;
/// Points of an edge closer than this part of its length are one.
constexpr double kClose = 1e-4;

/// An edge between two places, by the numbers that weldVertices() gives them.
using EdgeKey = std::uint64_t;

/// A vertex of a piece of a triangle.
struct PieceVertex {
    glm::dvec2 barycentric{0}; ///< in the triangle
    int edge = -1;             ///< from corner `edge` to the next one, where it is on an edge alone
    double along = 0;          ///< fraction of that edge, from its end of the lower number
};
using Polygon = std::vector<PieceVertex>;

struct Piece {
    std::uint32_t piece;
    Polygon polygon;
};

glm::dvec2 cornerAt(int k) {
    return {k == 1 ? 1 : 0, k == 2 ? 1 : 0};
}

/// The corner with these barycentrics; -1: none.
int cornerOf(glm::dvec2 b) {
    for (int k = 0; k < 3; ++k)
        if (b == cornerAt(k))
            return k;
    return -1;
}

/// A whole triangle.
Polygon wholeTriangle() {
    return {{cornerAt(0), -1, 0}, {cornerAt(1), -1, 0}, {cornerAt(2), -1, 0}};
}

/// Weight of corner k.
double weightOf(glm::dvec2 b, int k) {
    return k == 0 ? 1 - b.x - b.y : k == 1 ? b.x : b.y;
}

bool isOnEdge(const PieceVertex& v, int edge) {
    return std::abs(weightOf(v.barycentric, (edge + 2) % 3)) < kTiny;
}

double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

class MeshCutter {
public:
    MeshCutter(const Mesh& mesh, const MeshCharts& charts, const std::vector<ChartCuts>& cuts)
        : m_mesh(mesh), m_charts(charts), m_cuts(cuts), m_place(weldVertices(mesh, false)) {}

    CutMesh run();

private:
    std::uint32_t vertexOf(std::uint32_t t, int corner) const {
        return m_mesh.indices[3 * t + std::uint32_t(corner % 3)];
    }
    EdgeKey keyOf(std::uint32_t t, int edge) const {
        const EdgeKey a = m_place[vertexOf(t, edge)], b = m_place[vertexOf(t, edge + 1)];
        return std::min(a, b) << 32 | std::max(a, b);
    }
    /// Whether an edge runs from its end of the lower number.
    bool runsUp(std::uint32_t t, int edge) const {
        return m_place[vertexOf(t, edge)] <= m_place[vertexOf(t, edge + 1)];
    }
    glm::dvec2 uvOf(std::uint32_t t, int corner) const {
        return m_charts.chartUv[m_charts.indices[3 * t + std::uint32_t(corner % 3)]];
    }
    glm::dvec2 onEdge(std::uint32_t t, int edge, double along) const {
        const double s = runsUp(t, edge) ? along : 1 - along;
        return cornerAt(edge) * (1 - s) + cornerAt((edge + 1) % 3) * s;
    }
    PieceVertex crossing(std::uint32_t t, const PieceVertex& a, const PieceVertex& b, double share,
                         const ChartCuts::Node& cut) const;
    void cutPolygon(std::uint32_t t, std::uint32_t node, Polygon polygon, std::vector<Piece>& out);
    void joinEdgePoints();
    double joined(EdgeKey key, double along) const;
    Polygon withPointsBetween(std::uint32_t t, const Polygon& polygon,
                              const std::vector<PieceVertex>& inner) const;
    void addPieces(std::uint32_t t);
    std::uint32_t addVertex(std::uint32_t t, const PieceVertex& v);
    std::uint32_t blend(std::uint32_t t, glm::dvec2 barycentric);
    void addTriangle(std::uint32_t t, std::uint32_t piece, const PieceVertex& a,
                     const PieceVertex& b, const PieceVertex& c);
    void addPolygon(std::uint32_t t, std::uint32_t piece, const Polygon& polygon);
    void collectCharts();

    const Mesh& m_mesh;
    const MeshCharts& m_charts;
    const std::vector<ChartCuts>& m_cuts;
    std::vector<std::uint32_t> m_place;                         ///< per vertex
    std::vector<std::vector<Piece>> m_pieces;                   ///< per triangle
    std::unordered_map<EdgeKey, std::vector<double>> m_onEdges; ///< sorted
    CutMesh m_out;
    std::vector<std::uint32_t> m_pieceOfTriangle; ///< of the cut mesh
    std::map<std::tuple<std::uint32_t, std::uint32_t, double>, std::uint32_t> m_edgeVertices;
    std::map<std::pair<double, double>, std::uint32_t> m_innerVertices; ///< of the triangle at hand
};

PieceVertex MeshCutter::crossing(std::uint32_t t, const PieceVertex& a, const PieceVertex& b,
                                 double share, const ChartCuts::Node& cut) const {
    for (int edge = 0; edge < 3; ++edge) {
        if (!isOnEdge(a, edge) || !isOnEdge(b, edge))
            continue;
        // From the edge's own ends, so that all triangles of a chart find the same fraction.
        const bool up = runsUp(t, edge);
        const glm::dvec2 across(cut.across);
        const double from = glm::dot(across, uvOf(t, up ? edge : edge + 1)),
                     to = glm::dot(across, uvOf(t, up ? edge + 1 : edge));
        const double along = std::clamp((double(cut.position) - from) / (to - from), 0., 1.);
        return {onEdge(t, edge, along), edge, along};
    }
    return {glm::mix(a.barycentric, b.barycentric, share), -1, 0};
}

/// Cuts a convex part of a triangle along the cut of a node, and along those below it.
void MeshCutter::cutPolygon(std::uint32_t t, std::uint32_t node, Polygon polygon,
                            std::vector<Piece>& out) {
    const ChartCuts::Node& cut = m_cuts[m_charts.chartOfTriangle[t]].nodes[node];
    if (cut.isPiece()) {
        out.push_back({cut.child, std::move(polygon)});
        return;
    }
    const glm::dvec2 across(cut.across);
    const double a = glm::dot(across, uvOf(t, 0)), b = glm::dot(across, uvOf(t, 1)),
                 c = glm::dot(across, uvOf(t, 2));
    const double extent = std::max({a, b, c}) - std::min({a, b, c});
    std::vector<double> beyond;
    bool any[2] = {false, false};
    for (const PieceVertex& v : polygon) {
        double d = a * weightOf(v.barycentric, 0) + b * v.barycentric.x + c * v.barycentric.y -
                   double(cut.position);
        d = std::abs(d) <= 10 * kTiny * extent ? 0 : d;
        beyond.push_back(d);
        any[0] |= d < 0;
        any[1] |= d > 0;
    }
    if (!any[0] || !any[1]) { // a triangle without extent goes below
        cutPolygon(t, cut.child + (any[1] ? 1 : 0), std::move(polygon), out);
        return;
    }
    Polygon sides[2];
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const std::size_t next = (k + 1) % polygon.size();
        if (beyond[k] <= 0)
            sides[0].push_back(polygon[k]);
        if (beyond[k] >= 0)
            sides[1].push_back(polygon[k]);
        if (beyond[k] * beyond[next] < 0) {
            const PieceVertex v =
                crossing(t, polygon[k], polygon[next], beyond[k] / (beyond[k] - beyond[next]), cut);
            sides[0].push_back(v);
            sides[1].push_back(v);
        }
    }
    for (std::uint32_t side = 0; side < 2; ++side)
        cutPolygon(t, cut.child + side, std::move(sides[side]), out);
}

/// Collects the points of all edges, and joins close ones.
void MeshCutter::joinEdgePoints() {
    for (std::uint32_t t = 0; t < m_pieces.size(); ++t)
        for (const Piece& piece : m_pieces[t])
            for (const PieceVertex& v : piece.polygon)
                if (v.edge >= 0)
                    m_onEdges[keyOf(t, v.edge)].push_back(v.along);
    for (auto& [key, points] : m_onEdges) {
        std::ranges::sort(points);
        std::vector<double> kept;
        for (const double p : points)
            if (p > kClose && p < 1 - kClose && (kept.empty() || p - kept.back() > kClose))
                kept.push_back(p);
        points = std::move(kept);
    }
}

/// The point of an edge that stands for one of its points, or an end of it.
double MeshCutter::joined(EdgeKey key, double along) const {
    double best = along < 0.5 ? 0 : 1;
    const auto found = m_onEdges.find(key);
    if (found != m_onEdges.end())
        for (const double p : found->second)
            if (std::abs(p - along) < std::abs(best - along))
                best = p;
    return best;
}

/// The polygon with all points that others have on its sides.
Polygon MeshCutter::withPointsBetween(std::uint32_t t, const Polygon& polygon,
                                      const std::vector<PieceVertex>& inner) const {
    Polygon all;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const PieceVertex &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        all.push_back(a);
        const glm::dvec2 to = b.barycentric - a.barycentric;
        std::vector<std::pair<double, PieceVertex>> between; // by how far along
        const auto add = [&](const PieceVertex& v) {
            const glm::dvec2 offset = v.barycentric - a.barycentric;
            const double along = glm::dot(offset, to) / glm::dot(to, to);
            if (along > 0 && along < 1 && v.barycentric != a.barycentric &&
                v.barycentric != b.barycentric)
                between.emplace_back(along, v);
        };
        int edge = 0;
        while (edge < 3 && !(isOnEdge(a, edge) && isOnEdge(b, edge)))
            ++edge;
        if (edge < 3) {
            const auto found = m_onEdges.find(keyOf(t, edge));
            if (found != m_onEdges.end())
                for (const double p : found->second)
                    add({onEdge(t, edge, p), edge, p});
        } else {
            for (const PieceVertex& v : inner)
                if (std::abs(cross(to, v.barycentric - a.barycentric)) < kTiny * glm::length(to))
                    add(v);
        }
        std::ranges::sort(between, {}, [](const auto& entry) { return entry.first; });
        for (const auto& [along, v] : between)
            all.push_back(v);
    }
    return all;
}

/// A vertex with the attributes at a point of a triangle.
std::uint32_t MeshCutter::blend(std::uint32_t t, glm::dvec2 b) {
    Mesh& mesh = m_out.mesh;
    const auto index = std::uint32_t(mesh.positions.size());
    const auto mixed = [&](const auto& values) {
        using Value = std::remove_cvref_t<decltype(values[0])>;
        Value sum = values[vertexOf(t, 0)] * float(weightOf(b, 0));
        sum += values[vertexOf(t, 1)] * float(b.x);
        sum += values[vertexOf(t, 2)] * float(b.y);
        return sum;
    };
    const auto unit = [&](glm::vec3 v, glm::vec3 otherwise) {
        const float length = glm::length(v);
        return length > 0 ? v / length : otherwise;
    };
    mesh.positions.push_back(mixed(mesh.positions));
    if (!mesh.normals.empty())
        mesh.normals.push_back(unit(mixed(mesh.normals), mesh.normals[vertexOf(t, 0)]));
    if (!mesh.tangents.empty()) {
        const glm::vec4 first = mesh.tangents[vertexOf(t, 0)];
        mesh.tangents.emplace_back(unit(glm::vec3(mixed(mesh.tangents)), glm::vec3(first)),
                                   first.w);
    }
    if (!mesh.uv0.empty())
        mesh.uv0.push_back(mixed(mesh.uv0));
    if (!mesh.uv1.empty())
        mesh.uv1.push_back(mixed(mesh.uv1));
    for (std::vector<glm::vec2>& uv : mesh.furtherUv)
        if (!uv.empty())
            uv.push_back(mixed(uv));
    if (!mesh.colors.empty())
        mesh.colors.push_back(mixed(mesh.colors));
    return index;
}

std::uint32_t MeshCutter::addVertex(std::uint32_t t, const PieceVertex& v) {
    if (const int corner = cornerOf(v.barycentric); corner >= 0)
        return vertexOf(t, corner);
    if (v.edge < 0) {
        const auto [entry, isNew] =
            m_innerVertices.try_emplace({v.barycentric.x, v.barycentric.y}, 0);
        if (isNew)
            entry->second = blend(t, v.barycentric);
        return entry->second;
    }
    const bool up = runsUp(t, v.edge);
    const std::uint32_t a = vertexOf(t, up ? v.edge : v.edge + 1),
                        b = vertexOf(t, up ? v.edge + 1 : v.edge);
    const auto [entry, isNew] = m_edgeVertices.try_emplace({a, b, v.along}, 0);
    if (isNew) {
        entry->second = blend(t, v.barycentric);
        // The same in every triangle: barycentrics of others are rounded otherwise.
        m_out.mesh.positions[entry->second] = glm::vec3(
            glm::mix(glm::dvec3(m_mesh.positions[a]), glm::dvec3(m_mesh.positions[b]), v.along));
    }
    return entry->second;
}

void MeshCutter::addTriangle(std::uint32_t t, std::uint32_t piece, const PieceVertex& a,
                             const PieceVertex& b, const PieceVertex& c) {
    for (const PieceVertex* v : {&a, &b, &c})
        m_out.mesh.indices.push_back(addVertex(t, *v));
    m_out.source.triangle.push_back(t);
    m_out.source.corners.push_back(
        {glm::vec2(a.barycentric), glm::vec2(b.barycentric), glm::vec2(c.barycentric)});
    m_pieceOfTriangle.push_back(piece);
}

/// Triangulates a convex polygon, some of whose vertices may lie on straight sides: as a fan around
/// the vertex whose smallest triangle is largest, or around the middle where every such fan has a
/// triangle of next to no area.
void MeshCutter::addPolygon(std::uint32_t t, std::uint32_t piece, const Polygon& polygon) {
    const std::size_t n = polygon.size();
    const auto areaOf = [](const PieceVertex& a, const PieceVertex& b, const PieceVertex& c) {
        return cross(b.barycentric - a.barycentric, c.barycentric - a.barycentric);
    };
    double whole = 0;
    PieceVertex middle;
    for (std::size_t k = 0; k < n; ++k) {
        whole += areaOf(polygon[0], polygon[k], polygon[(k + 1) % n]);
        middle.barycentric += polygon[k].barycentric / double(n);
    }
    if (n < 3 || !(whole > kTiny * kTiny))
        return;
    constexpr std::size_t kMaxFan = 16; // vertices; the middle serves more of them better
    std::size_t root = n;
    double best = kClose * whole;
    for (std::size_t r = 0; r < n && n <= kMaxFan; ++r) {
        double least = whole;
        for (std::size_t k = 1; k + 1 < n; ++k)
            least =
                std::min(least, areaOf(polygon[r], polygon[(r + k) % n], polygon[(r + k + 1) % n]));
        if (least > best) {
            best = least;
            root = r;
        }
    }
    if (root == n)
        for (std::size_t k = 0; k < n; ++k)
            addTriangle(t, piece, middle, polygon[k], polygon[(k + 1) % n]);
    else
        for (std::size_t k = 1; k + 1 < n; ++k)
            addTriangle(t, piece, polygon[root], polygon[(root + k) % n],
                        polygon[(root + k + 1) % n]);
}

void MeshCutter::addPieces(std::uint32_t t) {
    m_innerVertices.clear();
    std::vector<PieceVertex> inner;
    for (Piece& piece : m_pieces[t]) {
        Polygon kept;
        for (PieceVertex v : piece.polygon) {
            if (v.edge >= 0) {
                v.along = joined(keyOf(t, v.edge), v.along);
                v.barycentric = onEdge(t, v.edge, v.along);
            } else if (cornerOf(v.barycentric) < 0) {
                const auto same = std::ranges::find_if(inner, [&](const PieceVertex& other) {
                    return glm::distance(other.barycentric, v.barycentric) < kTiny;
                });
                if (same == inner.end())
                    inner.push_back(v);
                else
                    v = *same;
            }
            if (kept.empty() || kept.back().barycentric != v.barycentric)
                kept.push_back(v);
        }
        while (kept.size() > 1 && kept.back().barycentric == kept.front().barycentric)
            kept.pop_back();
        piece.polygon = std::move(kept);
    }
    const std::size_t before = m_out.source.triangle.size();
    for (const Piece& piece : m_pieces[t])
        addPolygon(t, piece.piece, withPointsBetween(t, piece.polygon, inner));
    if (m_out.source.triangle.size() == before) { // without area
        const Polygon whole = wholeTriangle();
        addTriangle(t, m_pieces[t].front().piece, whole[0], whole[1], whole[2]);
    }
}

/// Numbers the pieces that have triangles, and makes charts of them.
void MeshCutter::collectCharts() {
    using Source = std::pair<std::uint32_t, std::uint32_t>; // chart and piece
    const auto sourceOf = [&](std::size_t i) {
        return Source(m_charts.chartOfTriangle[m_out.source.triangle[i]], m_pieceOfTriangle[i]);
    };
    std::map<Source, std::uint32_t> numbers;
    for (std::size_t i = 0; i < m_pieceOfTriangle.size(); ++i)
        numbers.try_emplace(sourceOf(i), 0);
    for (auto& [source, chart] : numbers) {
        chart = std::uint32_t(m_out.source.charts.size());
        m_out.source.charts.push_back({source.first, source.second});
    }
    std::vector<std::uint32_t> chartOfTriangle;
    std::vector<glm::vec2> corner;
    for (std::size_t i = 0; i < m_pieceOfTriangle.size(); ++i) {
        const std::uint32_t t = m_out.source.triangle[i];
        chartOfTriangle.push_back(numbers.at(sourceOf(i)));
        for (const glm::dvec2 b : m_out.source.corners[i])
            corner.emplace_back(uvOf(t, 0) * weightOf(b, 0) + uvOf(t, 1) * b.x + uvOf(t, 2) * b.y);
    }
    m_out.charts = splitIntoCharts(m_out.mesh, std::move(chartOfTriangle), corner);
}

CutMesh MeshCutter::run() {
    const auto triangles = std::uint32_t(m_mesh.triangleCount());
    m_pieces.resize(triangles);
    for (std::uint32_t t = 0; t < triangles; ++t) {
        if (m_cuts[m_charts.chartOfTriangle[t]].nodes.empty())
            m_pieces[t].push_back({0, wholeTriangle()});
        else
            cutPolygon(t, 0, wholeTriangle(), m_pieces[t]);
    }
    joinEdgePoints();
    m_out.mesh = m_mesh;
    m_out.mesh.indices.clear();
    for (std::uint32_t t = 0; t < triangles; ++t) {
        m_out.source.firstTriangle.push_back(std::uint32_t(m_out.source.triangle.size()));
        addPieces(t);
    }
    m_out.source.firstTriangle.push_back(std::uint32_t(m_out.source.triangle.size()));
    collectCharts();
    return std::move(m_out);
}

} // namespace

std::uint32_t ChartCuts::pieceAt(glm::vec2 uv) const {
    if (nodes.empty())
        return 0;
    std::uint32_t node = 0;
    while (!nodes[node].isPiece())
        node = nodes[node].child + (nodes[node].isAbove(uv) ? 1 : 0);
    return nodes[node].child;
}

MeshPoint CutSource::toSource(const MeshPoint& point) const {
    const std::array<glm::vec2, 3>& c = corners[point.triangle];
    const glm::vec2 b = point.barycentric;
    return {triangle[point.triangle], c[0] * (1 - b.x - b.y) + c[1] * b.x + c[2] * b.y};
}

MeshPoint CutSource::fromSource(const MeshPoint& point) const {
    MeshPoint best{firstTriangle[point.triangle], {}};
    double inside = -1e30; // the least weight of a corner
    for (std::uint32_t t = firstTriangle[point.triangle]; t < firstTriangle[point.triangle + 1];
         ++t) {
        const std::array<glm::vec2, 3>& c = corners[t];
        const glm::dvec2 a(c[0]), e1 = glm::dvec2(c[1]) - a, e2 = glm::dvec2(c[2]) - a,
                                  p = glm::dvec2(point.barycentric) - a;
        const double area = cross(e1, e2);
        if (area == 0)
            continue;
        const glm::dvec2 b(cross(p, e2) / area, cross(e1, p) / area);
        const double least = std::min({1 - b.x - b.y, b.x, b.y});
        if (least > inside) {
            inside = least;
            best = {t, glm::vec2(b)};
        }
    }
    return best;
}

CutMesh cutMesh(const Mesh& mesh, const MeshCharts& charts, const std::vector<ChartCuts>& cuts) {
    return MeshCutter(mesh, charts, cuts).run();
}

} // namespace limn
