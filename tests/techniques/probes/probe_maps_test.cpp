// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/probe_maps.h"

#include "engine/math/sh.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace limn::probe_maps_test {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Octahedron, FindsEachTexelByItsDirectionAndCoversTheSphere) {
    for (const std::uint32_t side : {1U, 8U, 48U, 64U}) {
        const Octahedron map{side};
        const std::vector<float> angles = map.solidAngles();
        double sum = 0;
        glm::dvec3 first(0);
        for (std::uint32_t t = 0; t < map.texels(); ++t) {
            const glm::vec3 d = map.direction(t);
            EXPECT_NEAR(glm::length(d), 1, 1e-6);
            EXPECT_EQ(map.texelAt(d * 3.f), t) << side;
            sum += double(angles[t]);
            first += glm::dvec3(d) * double(angles[t]);
        }
        EXPECT_NEAR(sum, 4 * kPi, 1e-5);
        if (side > 1) {
            EXPECT_LT(glm::length(first), 1e-5);
        }
    }
}

TEST(Octahedron, SolidAnglesAreThoseOfTheTexels) {
    // The share of evenly spread directions that fall into a texel.
    const Octahedron map{8};
    const std::vector<float> angles = map.solidAngles();
    std::vector<double> found(map.texels());
    constexpr int kSteps = 1500;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double z = 1 - (2 * i + 1.) / kSteps, r = std::sqrt(1 - z * z),
                         angle = 2 * kPi * (j + 0.5) / kSteps;
            found[map.texelAt(glm::vec3(r * std::cos(angle), r * std::sin(angle), z))] +=
                4 * kPi / kSteps / kSteps;
        }
    for (std::uint32_t t = 0; t < map.texels(); ++t)
        EXPECT_NEAR(double(angles[t]), found[t], 0.03 * found[t]) << t;
}

TEST(ProbeGrid, HasNearlyEqualStepsAndAboutAsManyProbesAsWanted) {
    const ProbeGrid grid = chooseProbes({glm::vec3(0), glm::vec3(30, 12, 18)}, 256);
    EXPECT_GT(grid.count(), 150U);
    EXPECT_LE(grid.count(), 256U);
    const glm::vec3 step = grid.step();
    EXPECT_LT(std::max({step.x, step.y, step.z}) / std::min({step.x, step.y, step.z}), 1.3f);
    EXPECT_EQ(grid.position(0), grid.bounds.lower + step / 2.f);
    EXPECT_NEAR(grid.position(grid.count() - 1).x, 30 - step.x / 2, 1e-4);
}

TEST(ProbeGrid, AFlatSceneHasProbesOnBothSidesAndAnEmptyOneNone) {
    const ProbeGrid flat = chooseProbes({glm::vec3(0, 2, 0), glm::vec3(10, 2, 10)}, 64);
    EXPECT_EQ(flat.size.y, 2U);
    EXPECT_GT(flat.position(flat.count() - 1).y, 2);
    EXPECT_LT(flat.position(0).y, 2);
    EXPECT_EQ(chooseProbes({}, 64).count(), 0U);
    EXPECT_EQ(chooseProbes({glm::vec3(0), glm::vec3(INFINITY)}, 64).count(), 0U);
}

/// Maps of one probe in the middle of a scene.
ProbeMaps mapsOf(const Scene& scene, const Bounds& bounds, std::uint32_t side = 64) {
    const TraceScene trace(scene);
    ProbeMaps maps = emptyMaps({bounds, glm::uvec3(1)}, side);
    traceProbe(scene, trace, 0, maps);
    return maps;
}

TEST(ProbeMaps, HaveTheDistancesOfTheWalls) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(-1), glm::vec3(1), true));
    const ProbeMaps maps = mapsOf(b.build(), {glm::vec3(-1), glm::vec3(1)});
    for (std::uint32_t t = 0; t < maps.map.texels(); ++t) {
        const glm::vec3 d = glm::abs(maps.map.direction(t));
        EXPECT_NEAR(maps.hits[t].distance, 1 / std::max({d.x, d.y, d.z}), 1e-4);
        EXPECT_EQ(maps.hits[t].side, 0U);
    }
    EXPECT_EQ(maps.inSolid[0], 0);
    for (const glm::vec2 m : maps.moments.texels) {
        EXPECT_GE(m.x, 1);
        EXPECT_LE(m.x, std::sqrt(3.f));
        EXPECT_GE(m.y, m.x * m.x * 0.9999f) << "no variance is negative";
    }
}

TEST(ProbeMaps, AProbeInASolidIsNotUsed) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(-1), glm::vec3(1), false));
    const ProbeMaps maps = mapsOf(b.build(), {glm::vec3(-1), glm::vec3(1)});
    EXPECT_EQ(maps.inSolid[0], 1);
    EXPECT_EQ(momentsWeight(maps.moments, 0, glm::vec3(0.3f, 0.1f, 0), glm::vec3(0, 1, 0)), 0);
    EXPECT_EQ(momentsWeight(maps.moments, 0, glm::vec3(0), glm::vec3(0, 1, 0)), 0);
}

TEST(GridMoments, ChebyshevsBoundIsOneAtTheMeanAndHalfADeviationBeyondIt) {
    const glm::vec2 moments(2, 4.25f); // mean 2, deviation 1/2
    EXPECT_EQ(shareInFront(moments, 1), 1);
    EXPECT_EQ(shareInFront(moments, 2), 1);
    EXPECT_NEAR(shareInFront(moments, 2.5f), 0.5, 1e-6);
    EXPECT_NEAR(shareInFront(moments, 3), 0.2, 1e-6);
    EXPECT_EQ(shareInFront({2, 4}, 2.001f), 0) << "a wall that faces the probe";
}

TEST(GridMoments, WeightsFallWithTheAngleAndBehindWalls) {
    GridMoments moments;
    moments.texels.assign(kGridDepthTexels, {2, 4.0001f});
    for (const bool smooth : {false, true}) {
        moments.smooth = smooth;
        const auto weight = [&](glm::vec3 way, glm::vec3 normal) {
            return momentsWeight(moments, 0, way, normal);
        };
        const glm::vec3 down(0, -1, 0), up(0, 1, 0), aside(1, 0, 0);
        EXPECT_GT(weight(down, up), weight(down, aside));
        EXPECT_GE(weight(down, aside), weight(down, down));
        EXPECT_GT(weight(down, down), 0);
        EXPECT_LT(weight(2.5f * down, up), 1e-3f * weight(down, up));
    }
    moments.smooth = false;
    EXPECT_NEAR(momentsWeight(moments, 0, {0, -1, 0}, {0, 1, 0}), 1, 1e-6);
    EXPECT_NEAR(momentsWeight(moments, 0, {0, -1, 0}, {1, 0, 0}), 0.05, 1e-6);
    EXPECT_NEAR(momentsWeight(moments, 0, {0, -3, 0}, {0, 1, 0}), 0.0002, 1e-6);
}

} // namespace
} // namespace limn::probe_maps_test
