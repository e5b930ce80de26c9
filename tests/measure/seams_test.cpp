// SPDX-License-Identifier: MIT
#include "engine/measure/seams.h"

#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace limn::seams_test {
namespace {

using namespace simple;

/// Two triangles that share an edge of sqrt(2) m, each a chart of one texel, the second turned
/// about that edge by `fold` [rad]; light falls on them from everywhere with irradiance `e`.
struct TwoCharts {
    Scene scene;
    LightmapLayout layout;
    IndirectField field;

    TwoCharts(glm::vec2 e, float fold, float scale) {
        const glm::vec3 middle(0.5f, 0.5f, 0), out(std::sqrt(0.5f), std::sqrt(0.5f), 0);
        const glm::vec3 tip =
            middle + std::sqrt(0.5f) * (std::cos(fold) * out + std::sin(fold) * glm::vec3(0, 0, 1));
        Mesh m;
        m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, tip};
        m.normals.assign(4, {0, 0, 1});
        m.indices = {0, 1, 2, 1, 3, 2};
        SceneBuilder b;
        b.addMaterial(lambert(glm::vec3(0.5f)));
        b.add(m, glm::mat4(glm::mat3(scale)));
        scene = b.build();
        layout.width = 2;
        layout.height = 1;
        layout.meshes = {{{0, 1, 2, 1, 3, 2}, {0, 1, 2, 3, 4, 5}, {0, 1}, {}, {}}};
        const glm::vec2 first(0.25f, 0.5f), second(0.75f, 0.5f);
        layout.instances = {{{first, first, first, second, second, second}}};
        field.lightmapWidth = 2;
        field.lightmapHeight = 1;
        field.lightmap.assign(2 * 9, glm::vec4(0));
        const float perIrradiance = 2 / std::sqrt(std::numbers::pi_v<float>); // E = pi c Y00
        field.lightmap[0] = glm::vec4(glm::vec3(e.x), 0) * perIrradiance;
        field.lightmap[1] = glm::vec4(glm::vec3(e.y), 0) * perIrradiance;
    }
    SeamError measure() const { return measureSeams(scene, layout, field); }
};

TEST(Seams, AnEdgeBetweenTwoChartsJumpsByTheirDifference) {
    const TwoCharts two({1, 3}, 0.3f, 10);
    const SeamError e = two.measure();
    EXPECT_NEAR(e.length, 10 * std::sqrt(2.), 1e-4);
    EXPECT_NEAR(e.jump, 2, 1e-5);
    EXPECT_NEAR(e.irradiance, 2, 1e-5);
    EXPECT_NEAR(e.relative(), 1, 1e-5);
    EXPECT_EQ(TwoCharts({2, 2}, 0.3f, 1).measure().relative(), 0);
}

TEST(Seams, ASharpEdgeIsNoSeam) {
    EXPECT_GT(TwoCharts({1, 3}, 0.5f, 1).measure().length, 0);
    EXPECT_EQ(TwoCharts({1, 3}, 0.55f, 1).measure().length, 0); // 31.5 degrees
}

/// Light of 1 in the first chart and 3 in the second.
SeamError smoothSeams(const TwoCharts& two, std::uint32_t samples) {
    return measureSeams(two.scene, two.layout,
                        [](std::uint32_t, const MeshPoint& p, glm::vec3) {
                            return glm::vec3(2 * float(p.triangle) + 1);
                        },
                        {.smooth = true, .samples = samples});
}

TEST(Seams, SmoothOnesAreThoseOfTheShadingNormals) {
    TwoCharts two({1, 3}, 0.55f, 10); // folded, with the normals of a plane
    for (const std::uint32_t samples : {1U, 7U}) {
        EXPECT_NEAR(smoothSeams(two, samples).length, 10 * std::sqrt(2.), 1e-4);
        EXPECT_NEAR(smoothSeams(two, samples).jump, 2, 1e-5);
        EXPECT_NEAR(smoothSeams(two, samples).irradiance, 2, 1e-5);
    }
    const auto lengthWithoutNormals = [](float fold) {
        TwoCharts flat({1, 3}, fold, 1);
        auto assets = std::make_shared<Assets>(*flat.scene.assets);
        assets->meshes[0].normals.clear();
        flat.scene.assets = assets;
        return smoothSeams(flat, 4).length;
    };
    EXPECT_GT(lengthWithoutNormals(0.034f), 0); // 1.95 degrees
    EXPECT_EQ(lengthWithoutNormals(0.036f), 0); // 2.06 degrees
}

TEST(Seams, WithinAChartThereIsNone) {
    TwoCharts two({1, 3}, 0, 1);
    two.layout.meshes[0].chartOfTriangle = {0, 0};
    EXPECT_EQ(two.measure().length, 0);
    EXPECT_EQ(two.measure().relative(), 0);
}

TEST(Seams, BothSidesAreReadAtTheSamePlaceOfAnEdge) {
    TwoCharts two({1, 3}, 0, 1);
    const std::vector<glm::vec4> before = two.field.lightmap;
    two.layout.width = two.field.lightmapWidth = 4;
    two.field.lightmap.assign(4 * 9, glm::vec4(0));
    for (std::size_t i = 0; i < 4; ++i) // from 1 to 3 along the edge, in either chart
        two.field.lightmap[i] = before[i % 2];
    const glm::vec2 a(0.125f, 0.5f), b(0.375f, 0.5f), half(0.5f, 0);
    two.layout.instances = {{{a, a, b, a + half, b + half, b + half}}};
    EXPECT_NEAR(two.measure().irradiance, 2, 1e-5);
    EXPECT_NEAR(two.measure().jump, 0, 1e-5);
}

} // namespace
} // namespace limn::seams_test
