// SPDX-License-Identifier: MIT
#include "engine/scene/light/light_parts.h"

#include "engine/scene/light/rectangle_light.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::light_parts_test {
namespace {

using namespace simple;

/// `width` x `depth`, 2 m above y = 0, shining down.
Light panel(float width, float depth, glm::vec2 at = glm::vec2(0)) {
    Light light;
    light.kind = LightKind::Rectangle;
    light.position = {at.x, 2, at.y};
    light.size = {width, depth};
    return light;
}

/// Rooms of 4 x 5 m and 3 m high, each turned about the vertical.
Scene rooms(const std::vector<glm::vec2>& at, bool inside = true, float turn = 0) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    const std::uint32_t mesh = b.addMesh(box({-2, 0, -2.5f}, {2, 3, 2.5f}, inside));
    for (const glm::vec2 p : at)
        b.addInstance(mesh, glm::rotate(glm::translate(glm::mat4(1), {p.x, 0, p.y}), turn,
                                        glm::vec3(0, 1, 0)));
    return b.build();
}

void expectRectangle(const Light& light, glm::vec2 lower, glm::vec2 upper,
                     float tolerance = 2e-3f) {
    const LightRectangle r = lightRectangle(light);
    EXPECT_NEAR(r.centre.y, 2, 1e-4f);
    for (const glm::vec2 uv : {glm::vec2(0), glm::vec2(1)}) {
        const glm::vec3 p = r.at(uv);
        EXPECT_TRUE(p.x > lower.x - tolerance && p.x < upper.x + tolerance) << p.x;
        EXPECT_TRUE(p.z > lower.y - tolerance && p.z < upper.y + tolerance) << p.z;
    }
    const glm::vec3 size = glm::abs(r.at({1, 1}) - r.at({0, 0}));
    EXPECT_NEAR(size.x, upper.x - lower.x, 2 * tolerance);
    EXPECT_NEAR(size.z, upper.y - lower.y, 2 * tolerance);
}

double areaOf(const std::vector<Light>& parts) {
    double sum = 0;
    for (const Light& part : parts)
        sum += double(part.size.x) * double(part.size.y);
    return sum;
}

TEST(LightParts, ALightWithinARoomIsWhole) {
    const Light light = panel(3, 4);
    const std::vector<Light> parts = partsBetweenWalls(light, rooms({{0, 0}}));
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0], light);
    Light onCeiling = light; // flush with it
    onCeiling.position.y = 3;
    EXPECT_EQ(partsBetweenWalls(onCeiling, rooms({{0, 0}})), std::vector<Light>{onCeiling});
}

TEST(LightParts, TheFirstIsThatInTheRoomHoweverLargeTheLight) {
    for (const float size : {8.f, 20.f, 100.f}) {
        const std::vector<Light> parts =
            partsBetweenWalls(panel(size, size, {0.5f, -0.5f}), rooms({{0, 0}}));
        ASSERT_EQ(parts.size(), 5U) << size; // and one on each side of it
        expectRectangle(parts[0], {-2, -2.5f}, {2, 2.5f});
        EXPECT_EQ(parts[0].strength, 100);
        EXPECT_NEAR(areaOf(parts), double(size) * size, 1e-4 * double(size) * size);
    }
}

TEST(LightParts, RoomsSideBySideHaveOneEach) {
    const std::vector<Light> parts =
        partsBetweenWalls(panel(30, 30), rooms({{0, 0}, {4.2f, 0}, {-4.2f, 1}}));
    expectRectangle(parts[0], {-2, -2.5f}, {2, 2.5f});
    for (const float x : {4.2f, -4.2f})
        EXPECT_TRUE(std::ranges::any_of(parts, [&](const Light& part) {
            return std::abs(part.position.x - x) < 1e-3f && std::abs(part.size.x - 4) < 1e-3f &&
                   std::abs(part.size.y - 5) < 1e-3f;
        })) << x;
    EXPECT_NEAR(areaOf(parts), 900, 18); // without the gaps between the rooms
}

TEST(LightParts, ARoomThatLiesAskewHasARectangleRoundIt) {
    const float turn = 0.6f;
    const std::vector<Light> parts = partsBetweenWalls(panel(50, 50), rooms({{0, 0}}, true, turn));
    ASSERT_EQ(parts.size(), 5U);
    const float x = 2 * std::cos(turn) + 2.5f * std::sin(turn),
                z = 2 * std::sin(turn) + 2.5f * std::cos(turn);
    expectRectangle(parts[0], {-x, -z}, {x, z}, 0.2f);
}

TEST(LightParts, AWallAcrossItMakesTwo) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({1, 0, -9}, {0, 0, 18}, {0, 9, 0}));
    const std::vector<Light> parts = partsBetweenWalls(panel(4, 2), b.build());
    ASSERT_EQ(parts.size(), 2U);
    expectRectangle(parts[0], {-2, -1}, {1, 1});
    expectRectangle(parts[1], {1, -1}, {2, 1});
}

TEST(LightParts, AWallAskewAcrossItLeavesItWhole) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({-9, 0, -8}, {18, 0, 16}, {0, 9, 0}));
    EXPECT_EQ(partsBetweenWalls(panel(4, 2), b.build()), std::vector<Light>{panel(4, 2)});
}

TEST(LightParts, InsideASolidThereIsNone) {
    const Light light = panel(20, 20, {6, 6});
    EXPECT_EQ(partsBetweenWalls(light, rooms({{0, 0}}, false)), std::vector<Light>{light});
}

} // namespace
} // namespace limn::light_parts_test
