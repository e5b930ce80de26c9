// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/probe_places.h"

#include "engine/core/parallel.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace limn::probe_places_test {
namespace {

TEST(ProbeFalloff, FallsSmoothlyFromOneToZero) {
    EXPECT_EQ(probeFalloff(0), 1);
    EXPECT_NEAR(probeFalloff(0.5f), 0.5, 1e-6);
    EXPECT_NEAR(probeFalloff(0.25f), 1 - probeFalloff(0.75f), 1e-6);
    EXPECT_EQ(probeFalloff(1), 0);
    EXPECT_EQ(probeFalloff(7), 0);
}

TEST(RemoveDensest, KeepsTheLonelyAndThinsOutTheCrowd) {
    std::vector<glm::vec3> points = {{10, 0, 0}};
    for (int i = 0; i < 8; ++i)
        points.emplace_back(0.1f * float(i), 0, 0);
    const std::vector<glm::vec3> left = removeDensest(points, 1, 3);
    ASSERT_EQ(left.size(), 3U);
    EXPECT_EQ(left[0], glm::vec3(10, 0, 0));
    EXPECT_EQ(left[1], points[1]) << "the ends of the row";
    EXPECT_EQ(left[2], points[8]);
    EXPECT_EQ(removeDensest(points, 1, 20), points);
}

/// The air in front of the middle of a surface.
OpenAir airOf(const Scene& scene, glm::vec3 at, glm::vec3 normal, std::uint32_t cells) {
    return findOpenAir(TraceScene(scene), std::vector{at}, std::vector{normal}, cells, {});
}

/// A room of 4 x 2 x 4 m with a closed block of 1 m in it, off all walls.
Scene roomWithBlock() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(0), {4, 2, 4}, true));
    b.add(simple::box({1.5f, 0.5f, 1.5f}, {2.5f, 1.5f, 2.5f}, false));
    return b.build();
}

TEST(OpenAir, FillsARoomAndNoSolidInIt) {
    const OpenAir air = airOf(roomWithBlock(), {2, 0, 0.3f}, {0, 1, 0}, 32);
    EXPECT_NEAR(air.volume, 4 * 2 * 4 - 1, 0.12 * 31);
    ASSERT_GT(air.besideSurfaces.size(), 500U);
    for (const glm::vec3 p : air.besideSurfaces) {
        EXPECT_TRUE(glm::all(glm::greaterThan(p, glm::vec3(0))) &&
                    glm::all(glm::lessThan(p, glm::vec3(4, 2, 4))));
        EXPECT_FALSE(glm::all(glm::greaterThan(p, glm::vec3(1.5f, 0.5f, 1.5f))) &&
                     glm::all(glm::lessThan(p, glm::vec3(2.5f, 1.5f, 2.5f))));
    }
}

TEST(OpenAir, IsNotAroundARoomWhoseWallsHaveNoOutside) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(0), {4, 2, 4}, true));
    const Scene scene = b.build();
    // As from the underside of a block that stands on the floor.
    const OpenAir outside = airOf(scene, {2, -0.01f, 2}, {0, -1, 0}, 16);
    EXPECT_TRUE(outside.besideSurfaces.empty());
    EXPECT_EQ(outside.volume, 0);
}

TEST(OpenAir, DoesNotPassAWallWithoutThickness) {
    simple::SceneBuilder b;
    Material m = simple::lambert(glm::vec3(0.5f));
    m.doubleSided = true;
    b.addMaterial(m);
    b.add(simple::box(glm::vec3(0), {4, 2, 2}, true));
    b.add(simple::quad({2, 0, 0}, {0, 2, 0}, {0, 0, 2}));
    const OpenAir air = airOf(b.build(), {1, 0, 1}, {0, 1, 0}, 16);
    ASSERT_FALSE(air.besideSurfaces.empty());
    for (const glm::vec3 p : air.besideSurfaces)
        EXPECT_LT(p.x, 2);
}

TEST(OpenAir, OfAPlaneIsOnItsFront) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
    const OpenAir air = airOf(b.build(), {0, 0, 0}, {0, 1, 0}, 8);
    ASSERT_FALSE(air.besideSurfaces.empty());
    for (const glm::vec3 p : air.besideSurfaces)
        EXPECT_TRUE(p.y > 0 || std::max(std::abs(p.x), std::abs(p.z)) > 0.5f) << "below its edges";
}

TEST(ProbePlaces, AreAboutAsManyAsWantedAndApart) {
    const OpenAir air = airOf(roomWithBlock(), {2, 0, 0.3f}, {0, 1, 0}, 32);
    const std::vector<glm::vec3> probes = placeProbes(air, 60);
    EXPECT_EQ(probes.size(), 60U);
    const double rho = std::cbrt(air.volume) / (std::cbrt(60.) - 1);
    for (const glm::vec3 p : probes) {
        float nearest = std::numeric_limits<float>::max();
        for (const glm::vec3 q : probes)
            if (q != p)
                nearest = std::min(nearest, glm::distance(p, q));
        EXPECT_GT(double(nearest), 0.4 * rho);
    }
    const ThreadLimit one(1);
    EXPECT_EQ(placeProbes(airOf(roomWithBlock(), {2, 0, 0.3f}, {0, 1, 0}, 32), 60), probes);
}

} // namespace
} // namespace limn::probe_places_test
