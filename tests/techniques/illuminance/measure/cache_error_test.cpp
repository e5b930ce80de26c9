// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/measure/cache_error.h"

#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <numbers>

namespace limn::cache_error_test {
namespace {

using namespace simple;

constexpr float kPi = std::numbers::pi_v<float>;

/// Two caches on the floor of a room of 2 x 2 x 2 m, one under the middle of its ceiling.
struct Room {
    SceneBuilder builder;
    Caches caches;
    CachePoints points;

    Room() {
        points.begin = {0};
        for (const glm::vec3 p : {glm::vec3(0), glm::vec3(0.7f, 0, 0.4f)}) {
            caches.kind.push_back(CacheKind::Hemisphere);
            caches.position.push_back(p);
            caches.normal.emplace_back(0, 1, 0);
            caches.texel.push_back(0);
            points.position.push_back(p);
            points.normal.emplace_back(0, 1, 0);
            points.begin.push_back(std::uint32_t(points.position.size()));
        }
        caches.lightmapCount = 2;
    }
};

TEST(CacheReference, InAnEvenlyGlowingRoomIsPiTimesItsRadiance) {
    Room room;
    room.builder.addMaterial(lambert(glm::vec3(0.5f), glm::vec3(1, 2, 3)));
    room.builder.add(box(glm::vec3(-1, 0, -1), glm::vec3(1, 2, 1), true));
    const TraceScene trace(room.builder.build());
    const CacheReference r = referenceIrradiance(trace, room.caches, room.points, 10, 4096);
    ASSERT_EQ(r.cache, (std::vector<std::uint32_t>{0, 1}));
    for (const glm::vec3 E : r.irradiance)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(E[c], kPi * float(c + 1), 1e-3f * float(c + 1));
    EXPECT_LT(r.noise, 1e-4);
}

TEST(CacheReference, UnderASunlitPlaneIsItsRadiosity) {
    Room room; // open but for a ceiling without end, lit from below
    room.builder.addMaterial(lambert(glm::vec3(0.5f)));
    room.builder.add(quad({-500, 2, -500}, {1000, 0, 0}, {0, 0, 1000}));
    Light sun;
    sun.kind = LightKind::Directional;
    sun.direction = {0, 1, 0};
    sun.strength = 8;
    room.builder.scene.lights = {sun};
    const TraceScene trace(room.builder.build());
    const CacheReference r = referenceIrradiance(trace, room.caches, room.points, 10, 4096);
    ASSERT_EQ(r.cache.size(), 2U);
    EXPECT_NEAR(r.irradiance[0].x, 4, 0.01);
    EXPECT_NEAR(r.irradiance[1].x, 4, 0.01);
}

TEST(CacheReference, PassesOverCachesInWalls) {
    Room room;
    room.builder.addMaterial(lambert(glm::vec3(0.5f)));
    room.builder.add(box(glm::vec3(0.5f, -1, -1), glm::vec3(2, 2, 1), false)); // round the second
    const TraceScene trace(room.builder.build());
    const CacheReference r = referenceIrradiance(trace, room.caches, room.points, 10, 1024);
    EXPECT_EQ(r.cache, (std::vector<std::uint32_t>{0}));
}

TEST(CompareCaches, CountsErrorAndBiasOverTheMean) {
    const Room room;
    CacheReference reference;
    reference.cache = {0, 1};
    reference.irradiance = {glm::vec3(kPi), glm::vec3(3 * kPi)};
    // Constant radiance 1 has c_0 = 2 sqrt(pi).
    const float one = 2 * std::sqrt(kPi);
    std::vector<glm::vec3> sh(2 * 9, glm::vec3(0));
    sh[0] = glm::vec3(one);
    sh[9] = glm::vec3(2 * one);
    const CacheError e = compareCaches(reference, room.caches, 3, sh);
    EXPECT_NEAR(e.bias, 3.0 / 4 - 1, 1e-5);
    EXPECT_NEAR(e.nrmse, std::sqrt(0.5) / 2, 1e-5); // errors 0 and pi, mean 2 pi
}

} // namespace
} // namespace limn::cache_error_test
