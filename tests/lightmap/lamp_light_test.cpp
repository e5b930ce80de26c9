// SPDX-License-Identifier: MIT
#include "engine/lightmap/lamp_light.h"

#include "engine/scene/light/rectangle_light.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace limn::lamp_light_test {
namespace {

using namespace simple;

constexpr std::uint32_t kSamples = 8, kSeeds = 30000;

/// A black material and a lamp's; a far corner makes the scene as large as the distances.
SceneBuilder lampScene() {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0)));
    b.addMaterial(lambert(glm::vec3(0), glm::vec3(7, 3, 1)));
    b.add(quad(glm::vec3(-150), {0.1f, 0, 0}, {0, 0.1f, 0}));
    return b;
}

/// 1 x 1 m, 6 mm thick; its upper side is at y = 0.
Mesh flatLamp() {
    Mesh lamp = box({-0.5f, -0.006f, -0.5f}, {0.5f, 0, 0.5f}, false);
    lamp.material = 1;
    return lamp;
}

double meanIrradiance(const LampLight& light, const WorldPoint& point) {
    double sum = 0;
    for (std::uint32_t s = 0; s < kSeeds; ++s)
        sum += light.at(point, 0.01f, s, light.pointsOnLamps(kSamples, 5 * s)).value;
    return sum / kSeeds;
}

TEST(LampLight, OfAPanelIsThatOfARectangleNearAndFar) {
    SceneBuilder b = lampScene();
    b.add(quad({-0.5f, 0, -0.5f}, {1, 0, 0}, {0, 0, 1}, 1)); // faces down
    const TraceScene trace(b.build());
    const LampLight light(trace);
    const LightRectangle panel{{0, 0, 0}, {0.5f, 0, 0}, {0, 0, 0.5f}, {0, -1, 0}, 1};
    for (const float below : {0.003f, 0.1f, 1.f, 30.f}) {
        const WorldPoint p{{0.2f, -below, 0.1f}, {0, 1, 0}};
        const double truth =
            double(rectangleIrradiance(panel, p.position, p.normal)) / std::numbers::pi;
        EXPECT_NEAR(meanIrradiance(light, p) / truth, 1, 0.02) << below;
    }
    EXPECT_EQ(meanIrradiance(light, {{0, 1, 0}, {0, -1, 0}}), 0) << "its back is dark";
}

// Beside a long strip of height h whose upper edge lies in the plane of the receiver, E is that of
// the radiosity times (1 - cos(atan(h / d))) / 2.
TEST(LampLight, BesideARimIsThatOfAStrip) {
    SceneBuilder b = lampScene();
    b.add(flatLamp());
    const TraceScene trace(b.build());
    const LampLight light(trace);
    const double area = 2 + 4 * 0.006;
    for (const double away : {0.001, 0.006, 0.03}) {
        const WorldPoint p{{0.5f + float(away), 0, 0.1f}, {0, -1, 0}};
        const double truth = (1 - std::cos(std::atan(0.006 / away))) / 2 / area;
        EXPECT_NEAR(meanIrradiance(light, p) / truth, 1, 0.05) << away;
    }
}

TEST(LampLight, LampsOfEqualFluxCountAlikeWhateverTheirArea) {
    SceneBuilder b = lampScene();
    Mesh ball = sphere(0.01f, 2, false, 1);
    b.add(ball);
    b.add(sphere(0.5f, 2, false, 1)).toWorld[3] = glm::vec4(100, 0, 0, 1);
    const TraceScene trace(b.build());
    const LampLight light(trace);
    const double small = meanIrradiance(light, {{0, -5, 0}, {0, 1, 0}}),
                 large = meanIrradiance(light, {{100, -5, 0}, {0, 1, 0}});
    EXPECT_NEAR(small / large, 1, 0.05);
    EXPECT_NEAR(small * 4 * std::numbers::pi * 25, 1, 0.05);
}

TEST(LampLight, PointsInAGapAreNotOpen) {
    SceneBuilder b = lampScene();
    b.add(flatLamp());
    const TraceScene trace(b.build());
    const LampLight light(trace);
    const LampPoints lamps = light.pointsOnLamps(kSamples, 1);
    EXPECT_EQ(light.at({{0, 0.001f, 0}, {0, -1, 0}}, 0.01f, 1, lamps).open, 0);
    EXPECT_GT(light.at({{0.6f, 0.001f, 0}, {0, -1, 0}}, 0.01f, 1, lamps).open, 0.8);
    EXPECT_TRUE(light.isNear({0.505f, 0, 0}, 0.01f, ~0U));
    EXPECT_FALSE(light.isNear({0.515f, 0, 0}, 0.01f, ~0U));
    EXPECT_FALSE(light.isNear({0.505f, 0, 0}, 0.01f, 1)) << "the lamp itself";
}

TEST(LampLight, NothingEmitsWithoutLamps) {
    SceneBuilder b = lampScene();
    b.add(box(glm::vec3(0), glm::vec3(1), true));
    const TraceScene trace(b.build());
    EXPECT_TRUE(LampLight(trace).none());
}

} // namespace
} // namespace limn::lamp_light_test
