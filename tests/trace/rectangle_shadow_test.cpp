// SPDX-License-Identifier: MIT
#include "engine/trace/rectangle_shadow.h"

#include "engine/lighting/direct_irradiance.h"
#include "tests/trace/simple_scene.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace limn::rectangle_shadow_test {
namespace {

/// 2 x 1 m, 3 m above the floor y = 0, shining down.
Light panel() {
    Light light;
    light.kind = LightKind::Rectangle;
    light.position = {0, 3, 0};
    light.size = {2, 1};
    light.strength = 5;
    light.color = {1, 0.5f, 0};
    return light;
}

/// A floor and, above it, a roof from x = 0 to +X as far as shadows reach.
Scene halfRoofed(float height) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}));
    b.add(simple::quad({0, height, 50}, {100, 0, 0}, {0, 0, -100}));
    return b.build();
}

/// Points that face up.
struct FloorPoints {
    std::vector<glm::vec3> position, normal;
    std::size_t size() const { return position.size(); }
};

/// Points on the floor along +X, from -2 to 2 m.
FloorPoints row(std::size_t count) {
    FloorPoints s;
    for (std::size_t i = 0; i < count; ++i) {
        s.position.push_back({4 * (float(i) + 0.5f) / float(count) - 2, 0, 0.1f});
        s.normal.push_back({0, 1, 0});
    }
    return s;
}

/// What the part of the panel that a point of the floor sees past the roof's edge sends there.
double seen(const Light& light, float roof, glm::vec3 p) {
    // The line through p and the edge meets the panel's plane at x = -p.x (3 - h) / h.
    const float edge = -p.x * (light.position.y - roof) / roof;
    const float lower = -light.size.x / 2, upper = std::min(edge, light.size.x / 2);
    if (!(upper > lower))
        return 0;
    Light part = light;
    part.size.x = upper - lower;
    part.position.x = (upper + lower) / 2;
    return double(rectangleIrradiance(lightRectangle(part), p, {0, 1, 0}));
}

TEST(RectangleShadow, UnderAnEdgeIsWhatTheSeenPartSends) {
    const float roof = 1;
    const Scene scene = halfRoofed(roof);
    const TraceScene trace(scene);
    const FloorPoints line = row(400);
    const LightRectangle rectangle = lightRectangle(panel());
    const auto nrmse = [&](std::uint32_t points) {
        double squares = 0, mean = 0;
        for (std::size_t i = 0; i < line.size(); ++i) {
            std::uint64_t rays = 0;
            const glm::vec2 shift(float(i * 7 % 16) / 16, float(i * 11 % 16) / 16);
            const double E = double(shadowedIrradiance(
                trace, rectangle, RectangleReceiver::flat(line.position[i], {0, 1, 0}), points,
                shift, rays));
            const double expected = seen(panel(), roof, line.position[i]);
            EXPECT_LE(rays, points);
            squares += (E - expected) * (E - expected);
            mean += expected;
        }
        return std::sqrt(squares / 400) / (mean / 400);
    };
    // One edge in the unit square: the error of n even points falls as n^-3/4 or better.
    EXPECT_LT(nrmse(4096), 2e-3);
    EXPECT_LT(nrmse(64), 0.02);
    EXPECT_LT(nrmse(DirectIrradiance::kRectanglePoints), 0.05);
}

TEST(RectangleShadow, PointsGetColourTimesRadianceTimesTheShare) {
    const Scene empty = [] {
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.5f)));
        b.add(simple::quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}));
        b.scene.lights = {panel()};
        return b.build();
    }();
    const TraceScene trace(empty);
    const FloorPoints line = row(50);
    DirectIrradiance state;
    EXPECT_TRUE(updateDirectIrradiance(line.position, line.normal, empty, trace, state));
    EXPECT_EQ(state.raysTraced, 50 * DirectIrradiance::kRectanglePoints);
    for (std::size_t i = 0; i < line.size(); ++i) {
        const float share =
            rectangleIrradiance(lightRectangle(panel()), line.position[i], {0, 1, 0});
        EXPECT_NEAR(state.irradiance[i].x, 5 * share, 1e-5f);
        EXPECT_NEAR(state.irradiance[i].y, 2.5f * share, 1e-5f);
        EXPECT_EQ(state.irradiance[i].z, 0);
    }
    Scene brighter = empty;
    brighter.lights[0].strength = 10;
    EXPECT_TRUE(updateDirectIrradiance(line.position, line.normal, brighter, trace, state));
    EXPECT_EQ(state.raysTraced, 0u) << "strength casts no other shadow";
    brighter.lights[0].size.x = 1;
    EXPECT_TRUE(updateDirectIrradiance(line.position, line.normal, brighter, trace, state));
    EXPECT_GT(state.raysTraced, 0u);
}

TEST(RectangleShadow, ALampOnACeilingIsNotInItsShadow) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box({-4, 0, -4}, {4, 3, 4}, true));
    const Scene scene = b.build();
    const TraceScene trace(scene);
    const LightRectangle rectangle = lightRectangle(panel()); // in the ceiling's plane
    std::uint64_t rays = 0;
    for (const float x : {-3.f, 0.f, 2.f})
        EXPECT_EQ(shadowedIrradiance(trace, rectangle,
                                     RectangleReceiver::flat({x, 0, 1}, {0, 1, 0}), 16, {}, rays),
                  rectangleIrradiance(rectangle, {x, 0, 1}, {0, 1, 0}));
}

// Every point of the floor sees all of the light that lies in the room, and nothing of the rest.
TEST(RectangleShadow, OfALightThatReachesThroughWallsIsThatOfItsPartInTheRoom) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box({-2, 0, -2.5f}, {2, 3, 2.5f}, true));
    const Scene scene = b.build();
    const TraceScene trace(scene);
    FloorPoints floor;
    for (float x = -1.9f; x < 2; x += 0.2f)
        for (float z = -2.4f; z < 2.5f; z += 0.2f) {
            floor.position.push_back({x, 0, z});
            floor.normal.push_back({0, 1, 0});
        }
    Light inRoom = panel();
    inRoom.position.y = 2.6f;
    inRoom.size = {4, 5};
    for (const float size : {8.f, 12.f, 20.f, 50.f, 100.f}) {
        Light light = inRoom;
        light.position += glm::vec3(0.5f, 0, -0.2f);
        light.size = glm::vec2(size);
        Scene lit = scene;
        lit.lights = {light};
        DirectIrradiance state;
        updateDirectIrradiance(floor.position, floor.normal, lit, trace, state);
        for (std::size_t i = 0; i < floor.size(); ++i) {
            const double truth = double(
                rectangleIrradiance(lightRectangle(inRoom), floor.position[i], floor.normal[i]));
            EXPECT_NEAR(double(state.irradiance[i].x), truth * double(light.strength),
                        1e-3 * truth * double(light.strength))
                << size;
        }
        // Points even in solid angle have no bias, though most of them are in shadow.
        double sum = 0, expected = 0;
        std::uint64_t rays = 0;
        for (std::size_t i = 0; i < floor.size(); ++i) {
            const glm::vec2 shift(float(i * 7 % 16) / 16, float(i * 11 % 16) / 16);
            sum += double(shadowedIrradiance(
                trace, lightRectangle(light),
                RectangleReceiver::flat(floor.position[i], floor.normal[i]), 64, shift, rays));
            expected += double(
                rectangleIrradiance(lightRectangle(inRoom), floor.position[i], floor.normal[i]));
        }
        EXPECT_NEAR(sum / expected, 1, 0.01) << size;
    }
}

} // namespace
} // namespace limn::rectangle_shadow_test
