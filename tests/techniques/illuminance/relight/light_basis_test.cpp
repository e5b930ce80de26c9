// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/light_basis.h"

#include "engine/techniques/illuminance/relight/source_solver.h"
#include "tests/techniques/illuminance/relight/relit.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace limn::light_basis_test {
namespace {

using namespace simple;

/// A room with two lamps, a shining plate, a ball that moves, and a sky through a missing wall.
struct LightBasisTest : testing::Test {
    Scene scene = room();
    std::optional<TraceScene> trace;
    std::shared_ptr<const Bake> baked;
    std::optional<Relighter> relighter;
    std::optional<SourceSolver> solver;

    LightBasisTest() { bake(); }
    void bake() {
        trace.emplace(scene);
        baked = bakeOf(*trace);
        relighter.emplace(baked);
        solver.emplace(baked);
    }

    static Scene room() {
        SceneBuilder b;
        b.addMaterial(lambert({0.8f, 0.5f, 0.3f}));
        Material plate = lambert({0.2f, 0.2f, 0.2f});
        plate.emission = {3, 2, 1};
        b.addMaterial(plate);
        b.add(box(glm::vec3(0), glm::vec3(4, 3, 5), true));
        b.add(box({1, 0.1f, 1}, {2, 0.2f, 2}, false, 1));
        b.add(box({2.5f, 0.5f, 2.5f}, {3, 1, 3}, false));
        b.scene.instances.back().dynamic = true;
        for (const glm::vec3 p : {glm::vec3(2, 2.5f, 2), glm::vec3(1, 2, 4)}) {
            Light& lamp = b.scene.lights.emplace_back();
            lamp.position = p;
            lamp.strength = 5;
        }
        b.scene.bake.surfels = 500;
        b.scene.bake.lightmapCaches = 500;
        b.scene.bake.rays = 64;
        b.scene.bake.links = 32;
        return b.build();
    }

    static constexpr std::uint32_t kAll = 400; ///< bounces

    void converge() { relighter->relight(scene, *trace, kAll); }
    /// Returns the number of steps.
    int solveAll() {
        int steps = 0;
        while (steps < 10000 && solver->solve(*relighter, scene, *trace, false, {}))
            ++steps;
        return steps;
    }
    /// The field of a relighter that has never known anything else.
    IndirectField anew() const {
        Relighter fresh(baked);
        fresh.relight(scene, *trace, kAll);
        return fresh.field();
    }
    /// Root mean square difference from the light of a new relighter, over its root mean square.
    double error() const {
        const IndirectField right = anew();
        double difference = 0, square = 0;
        for (const auto& [lit, truth] : {std::pair(&relighter->field().lightmap, &right.lightmap),
                                         std::pair(&relighter->field().grid, &right.grid)}) {
            EXPECT_EQ(lit->size(), truth->size());
            for (std::size_t i = 0; i < truth->size(); ++i) {
                const glm::vec4 d = (*lit)[i] - (*truth)[i];
                difference += double(glm::dot(d, d));
                square += double(glm::dot((*truth)[i], (*truth)[i]));
            }
        }
        return std::sqrt(difference / square);
    }
};

TEST_F(LightBasisTest, SumsAnyColoursAndStrengthsWithoutALinkOrARay) {
    converge();
    EXPECT_GT(solveAll(), 4);
    const std::pair<const char*, std::function<void()>> changes[] = {
        {"a lamp's colour",
         [&] {
             scene.lights[0].color = {0.2f, 1, 0.1f};
         }},
        {"a lamp's strength", [&] { scene.lights[1].strength = 40; }},
        {"a lamp off", [&] { scene.lights[1].enabled = false; }},
        {"a plate's emission",
         [&] {
             scene.materials[1].emission = {1, 5, 9};
         }},
        {"a plate that no longer shines", [&] { scene.materials[1].emission = glm::vec3(0); }},
        {"a sky that was black",
         [&] {
             scene.sky.radiance = {0.1f, 0.2f, 0.3f};
         }},
        {"a lamp on", [&] { scene.lights[1].enabled = true; }},
    };
    for (const auto& [name, change] : changes) {
        change();
        const RelightStats stats = relighter->relight(scene, *trace, 2);
        EXPECT_TRUE(stats.summed) << name;
        EXPECT_EQ(stats.links, 0u) << name;
        EXPECT_EQ(stats.shadowRays, 0u) << name;
        EXPECT_EQ(stats.bounces, 0u) << name;
        EXPECT_FALSE(stats.converged) << name;
        EXPECT_LT(error(), 6e-4) << name;
    }
    const RelightStats rest = relighter->relight(scene, *trace, kAll);
    EXPECT_FALSE(rest.summed);
    EXPECT_TRUE(rest.converged);
    EXPECT_LT(rest.bounces, 12u) << "sums leave little for bounces to change";
    EXPECT_LT(error(), 2e-4);
}

TEST_F(LightBasisTest, ReturnsToTheSameBits) {
    converge();
    solveAll();
    const std::vector<glm::vec4> before = relighter->field().lightmap;
    for (const float strength : {7.f, 5.f}) {
        scene.lights[0].strength = strength;
        EXPECT_TRUE(relighter->relight(scene, *trace, 2).summed);
    }
    EXPECT_EQ(relighter->field().lightmap, before);
}

TEST_F(LightBasisTest, IsVoidOnceSurfacesOrObjectsChange) {
    const std::pair<const char*, std::function<void()>> changes[] = {
        {"albedo",
         [&] {
             scene.materials[0].baseColor = {0.1f, 0.6f, 0.6f, 1};
         }},
        {"an object", [&] { scene.instances.back().toWorld[3].x += 0.5f; }},
        {"a setting", [&] { scene.relight.tolerance = 0.02f; }},
    };
    for (const auto& [name, change] : changes) {
        converge();
        solveAll();
        EXPECT_GT(relighter->relight(scene, *trace, 2).sourcesKept, 3u);
        change();
        trace.emplace(scene);
        EXPECT_FALSE(relighter->relight(scene, *trace, kAll).summed) << name;
        EXPECT_LT(error(), 4e-4) << name;
        scene.lights[0].strength += 1;
        EXPECT_FALSE(relighter->relight(scene, *trace, kAll).summed) << name;
        EXPECT_LT(error(), 4e-4) << name;
    }
}

TEST_F(LightBasisTest, DoesNotKnowALampThatHasMoved) {
    converge();
    solveAll();
    scene.lights[0].position.x = 1;
    EXPECT_FALSE(relighter->relight(scene, *trace, kAll).summed);
    scene.lights[0].strength = 9;
    EXPECT_FALSE(relighter->relight(scene, *trace, kAll).summed);
    EXPECT_LT(error(), 4e-4);
    const int steps = solveAll();
    EXPECT_GT(steps, 0);
    scene.lights[1].strength = 9; // its light was found before the other lamp moved
    EXPECT_TRUE(relighter->relight(scene, *trace, 2).summed);
    EXPECT_LT(error(), 6e-4);
}

TEST_F(LightBasisTest, ColoursThatMixAreKeptTogether) {
    scene.bake.chromaBands = 1;
    bake();
    scene.lights[0].color = {1, 0.3f, 0.1f};
    converge();
    solveAll();
    scene.lights[0].strength = 20;
    EXPECT_TRUE(relighter->relight(scene, *trace, 2).summed);
    EXPECT_LT(error(), 6e-4);
    scene.lights[0].color = {0.1f, 0.3f, 1};
    EXPECT_FALSE(relighter->relight(scene, *trace, kAll).summed);
    EXPECT_LT(error(), 4e-4);
}

TEST_F(LightBasisTest, ChangesThatRestartAreNotSummed) {
    scene.relight.maxBounces = 2;
    converge();
    EXPECT_EQ(solveAll(), 0);
}

WeightedSource lampAt(float x, float strength) {
    WeightedSource s{{.lamp = {}}, glm::vec3(strength)};
    s.source.lamp.position.x = x;
    return s;
}

TEST(LightBasis, KeepsTheBudgetByForgettingWhatWasUsedLongestAgo) {
    Scene scene;
    const std::vector<glm::vec3> light(40, glm::vec3(1)); // 10 caches of 4 coefficients
    const std::uint64_t each = 40 * 3 * 2 + 10 * 4;
    LightBasis basis(2 * each);
    std::vector<WeightedSource> sources{lampAt(0, 1), lampAt(1, 1), lampAt(2, 1)};
    basis.setSum(scene, sources, light, 4);
    for (int k = 0; k < 2; ++k) {
        ASSERT_EQ(basis.wanted(), sources[std::size_t(k)].source);
        basis.keep(*basis.wanted(), light);
    }
    EXPECT_FALSE(basis.wanted()) << "a third does not fit";
    std::vector<glm::vec3> out;
    sources[0].weight = glm::vec3(3);
    EXPECT_TRUE(basis.sum(sources, out)); // the second is now the older one
    EXPECT_FLOAT_EQ(out[7].y, 3);
    sources[2].weight = glm::vec3(2);
    EXPECT_FALSE(basis.sum(sources, out));
    ASSERT_EQ(basis.wanted(), sources[2].source) << "it was asked for";
    basis.keep(*basis.wanted(), light);
    EXPECT_EQ(basis.kept(), 2u);
    EXPECT_TRUE(basis.sum(sources, out));
    EXPECT_FLOAT_EQ(out[7].y, 4);
    EXPECT_FALSE(basis.wanted());
}

// 16 bits of the largest of a cache, however dark the cache is beside others.
TEST(LightBasis, IsAsExactInDarkCaches) {
    Scene scene;
    std::vector<glm::vec3> light;
    for (int i = 0; i < 400; ++i)
        light.push_back(glm::vec3(1, -0.37f, 0.011f * float(i % 4)) *
                        std::pow(10.f, -float(i / 40)));
    LightBasis basis;
    std::vector<WeightedSource> sources{lampAt(0, 0)};
    basis.setSum(scene, sources, std::vector<glm::vec3>(light.size(), glm::vec3(0)), 4);
    basis.keep(sources[0].source, light);
    sources[0].weight = {1, 2, 4};
    std::vector<glm::vec3> out;
    ASSERT_TRUE(basis.sum(sources, out));
    for (std::size_t i = 0; i < light.size(); ++i)
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(out[i][k], light[i][k] * sources[0].weight[k],
                        light[i].x * sources[0].weight[k] * 1.6e-5f);
}

} // namespace
} // namespace limn::light_basis_test
