// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/cut_mesh.h"

#include "engine/final_lightmap/chart_pieces.h"
#include "engine/final_lightmap/straight_charts.h"
#include "engine/lightmap/charts.h"
#include "engine/scene/mesh/mesh_topology.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/gtc/constants.hpp>

namespace limn::cut_mesh_test {
namespace {

using namespace simple;

/// Cuts that divide a chart of that size at random, `depth` times one after another.
void divide(ChartCuts& cuts, std::uint32_t node, glm::vec2 lower, glm::vec2 upper, int depth,
            std::mt19937& random, std::uint32_t& pieces, bool oblique) {
    std::uniform_real_distribution<float> part(0.1f, 0.9f);
    if (depth == 0 || random() % 4 == 0) {
        cuts.nodes[node].child = pieces++;
        return;
    }
    const float angle = random() % 2 == 0 || !oblique ? 0 : 3 * part(random);
    ChartCuts::Node cut;
    cut.across = {std::cos(angle), std::sin(angle)};
    cut.position = glm::dot(cut.across, lower + part(random) * (upper - lower));
    cut.child = std::uint32_t(cuts.nodes.size());
    cuts.nodes.resize(cut.child + 2);
    cuts.nodes[node] = cut;
    divide(cuts, cut.child, lower, upper, depth - 1, random, pieces, oblique);
    divide(cuts, cut.child + 1, lower, upper, depth - 1, random, pieces, oblique);
}

std::vector<ChartCuts> randomCuts(const MeshCharts& charts, std::uint32_t seed,
                                  bool oblique = true) {
    std::mt19937 random(seed);
    std::vector<ChartCuts> all(charts.chartSize.size());
    for (std::size_t c = 0; c < all.size(); ++c) {
        std::uint32_t pieces = 0;
        all[c].nodes.resize(1);
        divide(all[c], 0, glm::vec2(0), charts.chartSize[c], 4, random, pieces, oblique);
    }
    return all;
}

/// A ball of triangles, closed, with vertices that neighbours share.
Mesh ball(std::uint32_t rings) {
    Mesh m;
    const auto at = [&](std::uint32_t ring, std::uint32_t k) {
        const float polar = glm::pi<float>() * float(ring) / float(rings),
                    around = glm::pi<float>() * float(k) / float(rings);
        if (ring == 0 || ring == rings)
            return glm::vec3(0, ring == 0 ? 1 : -1, 0);
        return glm::vec3(std::sin(polar) * std::cos(around), std::cos(polar),
                         std::sin(polar) * std::sin(around));
    };
    for (std::uint32_t ring = 0; ring <= rings; ++ring)
        for (std::uint32_t k = 0; k < 2 * rings; ++k) {
            m.positions.push_back(at(ring, k));
            m.normals.push_back(at(ring, k));
            m.uv0.emplace_back(float(k), float(ring));
        }
    const auto index = [&](std::uint32_t ring, std::uint32_t k) {
        return ring * 2 * rings + k % (2 * rings);
    };
    for (std::uint32_t ring = 0; ring < rings; ++ring)
        for (std::uint32_t k = 0; k < 2 * rings; ++k) {
            if (ring > 0)
                m.indices.insert(m.indices.end(),
                                 {index(ring, k), index(ring, k + 1), index(ring + 1, k)});
            if (ring + 1 < rings)
                m.indices.insert(m.indices.end(),
                                 {index(ring, k + 1), index(ring + 1, k + 1), index(ring + 1, k)});
        }
    return m;
}

double areaOf(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
        sum += double(triangleArea(mesh, t));
    return sum;
}

std::size_t borderEdges(const Mesh& mesh) {
    return std::size_t(std::ranges::count(edgePartners(mesh), kNoEdge));
}

TEST(CutMesh, KeepsAreaAndClosedSurfacesClosed) {
    for (const Mesh& mesh : {ball(8), box({-1, 0, -2}, {3, 1, 2}, false)}) {
        const MeshCharts charts = buildCharts(mesh);
        for (std::uint32_t seed = 0; seed < 20; ++seed) {
            const CutMesh cut = cutMesh(mesh, charts, randomCuts(charts, seed));
            EXPECT_GT(cut.mesh.triangleCount(), mesh.triangleCount());
            EXPECT_NEAR(areaOf(cut.mesh), areaOf(mesh), 1e-4 * areaOf(mesh)) << seed;
            EXPECT_EQ(borderEdges(cut.mesh), 0U) << seed;
        }
    }
}

TEST(CutMesh, LeadsBackAndForth) {
    const Mesh mesh = ball(5);
    const MeshCharts charts = buildCharts(mesh);
    const CutMesh cut = cutMesh(mesh, charts, randomCuts(charts, 3));
    for (std::uint32_t t = 0; t < cut.mesh.triangleCount(); ++t) {
        const MeshPoint point{t, {0.3f, 0.5f}};
        const MeshPoint source = cut.source.toSource(point);
        const glm::vec3 there = trianglePoint(mesh, source.triangle, source.barycentric);
        EXPECT_LT(glm::distance(trianglePoint(cut.mesh, t, point.barycentric), there), 1e-3f);
        EXPECT_GT(glm::dot(triangleNormal(cut.mesh, t), triangleNormal(mesh, source.triangle)),
                  0.9f);
        const MeshPoint back = cut.source.fromSource(source);
        EXPECT_LT(glm::distance(trianglePoint(cut.mesh, back.triangle, back.barycentric), there),
                  1e-3f);
    }
}

/// Attributes are those of the plane that the triangle is in, exact on a quad.
TEST(CutMesh, InterpolatesAttributes) {
    Mesh mesh = quad({0, 0, 0}, {4, 0, 0}, {0, 0, -2});
    mesh.uv0.clear();
    for (const glm::vec3 p : mesh.positions)
        mesh.uv0.emplace_back(3 * p.x + 1, 2 * p.z - p.x);
    const MeshCharts charts = buildCharts(mesh);
    const CutMesh cut = cutMesh(mesh, charts, randomCuts(charts, 5));
    ASSERT_EQ(cut.mesh.uv0.size(), cut.mesh.positions.size());
    ASSERT_EQ(cut.mesh.normals.size(), cut.mesh.positions.size());
    for (std::size_t v = 0; v < cut.mesh.positions.size(); ++v) {
        const glm::vec3 p = cut.mesh.positions[v];
        EXPECT_NEAR(cut.mesh.uv0[v].x, 3 * p.x + 1, 1e-4f);
        EXPECT_NEAR(cut.mesh.uv0[v].y, 2 * p.z - p.x, 1e-4f);
        EXPECT_NEAR(glm::length(cut.mesh.normals[v]), 1, 1e-5f);
    }
}

TEST(CutMesh, GivesEachPieceAChartWithItsPartOfThePlane) {
    const Mesh mesh = quad({0, 0, 0}, {4, 0, 0}, {0, 0, -2});
    const MeshCharts charts = buildCharts(mesh);
    const std::vector<ChartCuts> cuts = randomCuts(charts, 1, false);
    const CutMesh cut = cutMesh(mesh, charts, cuts);
    double area = 0;
    for (const glm::vec2 size : cut.charts.chartSize)
        area += double(size.x) * double(size.y);
    EXPECT_NEAR(area, 8, 1e-3);
    ASSERT_EQ(cut.charts.indices.size(), cut.mesh.indices.size());
    for (std::uint32_t t = 0; t < cut.mesh.triangleCount(); ++t) {
        const MeshPoint middle = cut.source.toSource({t, glm::vec2(1 / 3.f)});
        glm::vec2 uv(0);
        const glm::vec2 b = middle.barycentric;
        for (std::size_t k = 0; k < 3; ++k)
            uv += charts.chartUv[charts.indices[3 * middle.triangle + k]] *
                  (k == 0 ? 1 - b.x - b.y : b[int(k) - 1]);
        const CutSource::Chart source = cut.source.charts[cut.charts.chartOfTriangle[t]];
        EXPECT_EQ(cuts[source.chart].pieceAt(uv), source.piece);
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(cut.charts.sourceVertex[cut.charts.indices[3 * t + k]],
                      cut.mesh.indices[3 * t + k]);
    }
}

TEST(CutMesh, LeavesWholeChartsAsTheyAre) {
    const Mesh mesh = ball(4);
    const MeshCharts charts = buildCharts(mesh);
    const CutMesh cut = cutMesh(mesh, charts, std::vector<ChartCuts>(charts.chartSize.size()));
    EXPECT_EQ(cut.mesh, mesh);
    EXPECT_EQ(cut.charts.chartSize.size(), charts.chartSize.size());
    EXPECT_EQ(cut.charts.chartOfTriangle, charts.chartOfTriangle);
}

/// A strip that is drawn across its plane gets a rectangle as long and wide as itself.
TEST(StraightCharts, PutRectanglesAroundStrips) {
    const Mesh mesh = quad({0, 0, 0}, {4, 0, 3}, {-0.03f, 0, 0.04f});
    MeshCharts charts = buildCharts(mesh);
    const MeshCharts before = charts;
    straightenCharts(charts);
    ASSERT_EQ(charts.chartSize.size(), 1U);
    const glm::vec2 size = charts.chartSize[0];
    EXPECT_NEAR(std::max(size.x, size.y), 5, 1e-4f);
    EXPECT_NEAR(std::min(size.x, size.y), 0.05f, 1e-4f);
    for (std::size_t i = 0; i < charts.chartUv.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            EXPECT_NEAR(glm::distance(charts.chartUv[i], charts.chartUv[k]),
                        glm::distance(before.chartUv[i], before.chartUv[k]), 1e-4f);
            EXPECT_GE(charts.chartUv[i].y, 0);
        }
    const MeshCharts straight = charts;
    straightenCharts(charts);
    EXPECT_EQ(charts, straight);
}

std::vector<ResidualSample> samplesOf(float (*squared)(glm::vec2)) {
    std::vector<ResidualSample> samples;
    for (float x = 0.05f; x < 8; x += 0.1f)
        for (float y = 0.05f; y < 8; y += 0.1f)
            samples.push_back({.uv = {x, y},
                               .width = 0.2f,
                               .area = 0.25f,
                               .light = 1,
                               .squared = squared({x, y}),
                               .floor = 1e-4f});
    return samples;
}

TEST(ChartPieces, CutsWhereErrorsDiffer) {
    const PieceDensity texels{5, [](double squared) { return 4 * std::sqrt(std::sqrt(squared)); }};
    ChartCuts cuts;
    std::vector<ResidualSample> even = samplesOf([](glm::vec2) { return 0.01f; });
    EXPECT_EQ(cutIntoPieces(even, {}, 1, texels, cuts).size(), 1U);
    EXPECT_TRUE(cuts.nodes.empty());
    std::vector<ResidualSample> corner =
        samplesOf([](glm::vec2 uv) { return uv.x < 2 && uv.y < 2 ? 1.f : 0.f; });
    const std::vector<ResidualSums> pieces = cutIntoPieces(corner, {}, 1, texels, cuts);
    EXPECT_GT(pieces.size(), 2U);
    const ResidualSums& inside = pieces[cuts.pieceAt({1, 1})];
    EXPECT_NEAR(inside.area, 4 * 25, 0.1);
    EXPECT_NE(cuts.pieceAt({1, 1}), cuts.pieceAt({3, 1}));
    EXPECT_NE(cuts.pieceAt({1, 1}), cuts.pieceAt({1, 3}));
    // A squared error of 1 over the mean squared light, 1, and dim light squared, 1.
    EXPECT_NEAR(inside.relative(1), 0.5 + 1e-4, 1e-3);
}

/// A wall as thick as half a texel stands across a chart, at an angle.
TEST(ChartPieces, CutsAlongWhatCrossesAChart) {
    const PieceDensity texels{5, [](double) { return 1.; }};
    const glm::vec2 across = glm::normalize(glm::vec2(3, 1)), along(-across.y, across.x);
    std::vector<glm::vec2> crossings;
    for (float s = -6; s < 6; s += 0.07f)
        for (const float side : {5.f, 5.1f})
            if (const glm::vec2 p = side * across + s * along;
                p.x > 0 && p.x < 8 && p.y > 0 && p.y < 8)
                crossings.push_back(p);
    std::vector<ResidualSample> samples = samplesOf([](glm::vec2) { return 0.01f; });
    ChartCuts cuts;
    const std::vector<ResidualSums> pieces = cutIntoPieces(samples, crossings, 1, texels, cuts);
    EXPECT_EQ(pieces.size(), 3U);
    const auto pieceAt = [&](float position) { return cuts.pieceAt(position * across + along); };
    EXPECT_NE(pieceAt(4.99f), pieceAt(5.01f));
    EXPECT_EQ(pieceAt(5.01f), pieceAt(5.09f));
    EXPECT_NE(pieceAt(5.09f), pieceAt(5.11f));
    // What stands about here and there leaves a chart whole.
    crossings.resize(crossings.size() / 3);
    EXPECT_EQ(cutIntoPieces(samples, crossings, 1, texels, cuts).size(), 1U);
}

} // namespace
} // namespace limn::cut_mesh_test
