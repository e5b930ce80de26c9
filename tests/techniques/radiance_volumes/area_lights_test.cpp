// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/area_lights.h"

#include "tests/techniques/lights_of_each_kind.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace limn::area_lights_test {
namespace {

constexpr double kPi = std::numbers::pi;

Scene room() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.5f, 0.4f, 0.2f}));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false));
    return b.build();
}

TEST(AreaLights, LevelsKeepTheFluxOfTheirMap) {
    const Scene scene = room();
    const TraceScene trace(scene);
    for (const LightKind kind : kLightKinds) {
        const Light light = lightOf(kind);
        const ReflectiveShadowMap map = castRsm(trace, scene, light, 32);
        double flux = 0;
        for (const RsmTexel& t : map.texels)
            flux += double(t.albedo.x * t.incident);
        const std::vector<RsmView> views = rsmViews(
            light, scene.bounds, 32, [&](glm::vec3 p, glm::vec3 n) { return trace.clearOf(p, n); });
        std::vector<double> sums(6, 0);
        for (std::uint32_t v = 0; v < views.size(); ++v) {
            std::vector<RsmTexel> texels;
            std::ranges::copy_if(map.texels, std::back_inserter(texels),
                                 [&](const RsmTexel& t) { return t.view == v; });
            const std::vector<RsmLevel> levels = rsmLevels(views[v], texels);
            EXPECT_EQ(levels.back().side, 1U);
            for (std::size_t k = 0; k < levels.size(); ++k)
                for (const RsmLevelTexel& t : levels[k].texels)
                    sums[k] += double(t.flux.x);
        }
        std::erase(sums, 0); // a rectangle's views have a level less
        EXPECT_TRUE(sums.size() >= 5 || flux == 0);
        for (const double sum : sums)
            EXPECT_NEAR(sum, flux, 1e-3 * flux);
        EXPECT_EQ(flux > 0, kind != LightKind::Directional) << "the room is closed";
    }
}

TEST(AreaLights, HoldTheFluxOfTheMapWhereSurfacesAreFlat) {
    const Scene scene = room();
    const TraceScene trace(scene);
    for (const LightKind kind : kLightKinds) {
        const Light light = lightOf(kind);
        const AreaLights lights = areaLightsOf(trace, scene, light, {.map = 64, .read = 16});
        double flux = 0, truth = 0, shares = 0;
        for (const RsmTexel& t : castRsm(trace, scene, light, 64).texels)
            truth += double(t.albedo.x * t.incident);
        for (const glm::vec3 f : lights.flux)
            flux += double(f.x);
        for (const AreaLights::Share& share : lights.shares)
            shares += double(share.flux.x);
        EXPECT_NEAR(flux, truth, 1e-3 * truth);
        EXPECT_NEAR(shares, truth, 1e-3 * truth);
        EXPECT_LE(lights.count(), std::size_t(2 * 16 * 16));
        std::uint32_t next = 0;
        for (const AreaLightBlock& block : lights.blocks) {
            EXPECT_EQ(block.begin, next);
            EXPECT_GT(block.end, block.begin);
            next = block.end;
        }
        EXPECT_EQ(next, lights.count());
    }
}

// The middle of a texel's mean distance lies on a wall that faces the beam.
TEST(AreaLights, LieOnTheSurfacesThatTheyStandFor) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(-2), glm::vec3(2), true));
    const Scene scene = b.build();
    const TraceScene trace(scene);
    const AreaLights sun = areaLightsOf(
        trace, scene, {.kind = LightKind::Directional, .direction = glm::vec3(0, -1, 0)},
        {.map = 64, .read = 8});
    // Nothing reaches a closed room from outside.
    EXPECT_EQ(sun.count(), 0U);
    const AreaLights point =
        areaLightsOf(trace, scene, {.kind = LightKind::Point}, {.map = 64, .read = 16, .level = 1});
    double area = 0;
    for (std::size_t j = 0; j < point.count(); ++j) {
        const glm::vec3 p(point.x[j], point.y[j], point.z[j]),
            n(point.nx[j], point.ny[j], point.nz[j]);
        EXPECT_NEAR(glm::dot(p, -n), 2, 0.1) << "walls are 2 m away";
        area += double(point.disc[j]);
    }
    // Across the beam, walls have the integral of d^2 over all directions: that of h / d over the
    // six faces, whose half-side is h.
    double truth = 0;
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const double x = 4 * (i % kSteps + 0.5) / kSteps - 2,
                     y = 4 * (i / kSteps + 0.5) / kSteps - 2;
        truth += 6 * 16. / (kSteps * kSteps) * 2 / std::sqrt(x * x + y * y + 4);
    }
    EXPECT_NEAR(area * kPi, truth, 2e-3 * truth);
    EXPECT_EQ(point.blocks.size(), point.count() / 4);
    for (const AreaLightBlock& block : point.blocks)
        EXPECT_FLOAT_EQ(block.width, 0.5f) << "four along a face that is 2 wide at a distance of 1";
}

TEST(AreaLights, AreReadOfALevelThatViewsShare) {
    EXPECT_EQ(sideRead(32, 1, 128), 32U);
    EXPECT_EQ(sideRead(32, 6, 128), 16U);  // 13.1
    EXPECT_EQ(sideRead(32, 24, 128), 8U);  // 6.5
    EXPECT_EQ(sideRead(64, 24, 128), 16U); // 13.1
    EXPECT_EQ(sideRead(256, 1, 128), 128U) << "no more than there are";
    EXPECT_EQ(sideRead(4, 24, 128), 1U);
}

TEST(AreaLights, SplitTheirFluxByInstance) {
    const Scene scene = room();
    const TraceScene trace(scene);
    const AreaLights lights =
        areaLightsOf(trace, scene, lightOf(LightKind::Point), {.map = 32, .read = 16});
    std::vector<glm::dvec3> sum(lights.count(), glm::dvec3(0));
    bool both = false;
    for (const AreaLights::Share& share : lights.shares) {
        sum[share.light] += glm::dvec3(share.flux);
        both |= share.instance == 1;
    }
    EXPECT_TRUE(both);
    for (std::size_t j = 0; j < lights.count(); ++j)
        EXPECT_NEAR(sum[j].x, double(lights.flux[j].x), 1e-4 * sum[j].x);
}

} // namespace
} // namespace limn::area_lights_test
