// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/light_caches.h"

#include "engine/gallery/hostile_shapes.h"
#include "engine/math/sampling.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace limn::skin_caches_test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

std::vector<std::pair<std::string, Mesh>> meshes() {
    Mesh hills;
    RandomStream random(5);
    addHills(hills, {4, 1.5, 4}, 24, random);
    return {{"sphere", simple::sphere(1, 3, false)},
            {"room", simple::box({0, 0, 0}, {3, 2, 4}, true)},
            {"hills", hills}};
}

/// Points spread evenly over the area of a mesh: triangle and barycentrics.
std::vector<MeshPoint> pointsOn(const Mesh& mesh, std::uint32_t count) {
    const TriangleGeometry geometry = triangleGeometry(mesh);
    double area = 0;
    for (const float a : geometry.area)
        area += double(a);
    std::vector<MeshPoint> points;
    double upTo = 0;
    std::uint32_t t = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
        while (t + 1 < mesh.triangleCount() &&
               upTo + double(geometry.area[t]) < (k + 0.5) / count * area)
            upTo += double(geometry.area[t++]);
        points.push_back({t, sampleTriangle({radicalInverse(k, 2), radicalInverse(k, 3)})});
    }
    return points;
}

TEST(SkinCaches, LieNearEverySurfacePointWithANormalThatFits) {
    constexpr SkinSpacing kSpacing{0.4f, kPi / 6};
    for (const auto& [name, mesh] : meshes()) {
        SCOPED_TRACE(name);
        const MeshSkin skin = skinOf(mesh, kSpacing, false, false);
        double area = 0;
        for (const MeshCache& cache : skin.caches) {
            area += double(cache.area);
            EXPECT_NEAR(glm::length(cache.normal), 1, 1e-5f);
        }
        EXPECT_NEAR(area / simple::areaOf(mesh), 1, 1e-4);
        std::size_t uncovered = 0;
        for (const MeshPoint& point : pointsOn(mesh, 10000)) {
            const glm::vec3 p = trianglePoint(mesh, point.triangle, point.barycentric),
                            n = triangleNormal(mesh, point.triangle);
            bool near = false;
            for (const MeshCache& cache : skin.caches)
                near |= glm::distance(cache.position, p) <= kSpacing.distance * 1.0001f &&
                        glm::dot(cache.normal, n) >= std::cos(2 * kSpacing.angle) - 1e-4f;
            uncovered += near ? 0 : 1;
        }
        EXPECT_EQ(uncovered, 0U);
    }
}

TEST(SkinCaches, OfASquareAreNoMoreThanItsCubes) {
    for (const float side : {0.3f, 1.f, 2.5f}) {
        const Mesh mesh = simple::quad({0.13f, 0, -0.4f}, {0, 0, side}, {side, 0, 0});
        for (const float distance : {0.1f, 0.33f, 1.f}) {
            const MeshSkin skin = skinOf(mesh, {distance, kPi / 6}, false, false);
            const double row = std::ceil(2 * double(side / distance)) + 1;
            EXPECT_LE(double(skin.caches.size()), row * row);
            EXPECT_GE(double(skin.caches.size()),
                      double(side * side) / (4 * double(distance * distance)))
                << "none reaches farther than the distance";
        }
    }
}

TEST(SkinCaches, LieOnBothSidesOfTwoSidedSurfaces) {
    const Mesh mesh = simple::quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0});
    const MeshSkin one = skinOf(mesh, {0.3f, 0.5f}, false, false),
                   two = skinOf(mesh, {0.3f, 0.5f}, true, false);
    EXPECT_EQ(two.caches.size(), 2 * one.caches.size());
    const NearestCaches* below = two.find({0.5f, 0, 0.5f}, {0, -1, 0});
    ASSERT_TRUE(below);
    EXPECT_LT(two.caches[below->cache[0]].normal.y, -0.99f);
}

// The lists of a cube come first by side, then by distance from the cube's surfaces.
TEST(SkinCaches, AreListedByDistanceThoseThatFaceTheSideFirst) {
    const Mesh mesh = simple::box({0, 0, 0}, {2, 2, 2}, true);
    const MeshSkin skin = skinOf(mesh, {0.3f, 0.5f}, false, false);
    for (const MeshPoint& point : pointsOn(mesh, 500)) {
        const glm::vec3 p = trianglePoint(mesh, point.triangle, point.barycentric),
                        n = triangleNormal(mesh, point.triangle);
        const NearestCaches* list = skin.find(p, n);
        ASSERT_TRUE(list);
        bool turned = false;
        for (const std::uint32_t c : list->cache) {
            ASSERT_NE(c, NearestCaches::kNone);
            const bool faces = glm::dot(skin.caches[c].normal, n) > 0;
            EXPECT_FALSE(faces && turned);
            turned |= !faces;
        }
        // The nearest cache of the side is in the list: it lies within the spacing of all 16.
        float nearest = 1e9f, listed = 1e9f;
        for (const MeshCache& cache : skin.caches)
            if (glm::dot(cache.normal, n) > 0.9f)
                nearest = std::min(nearest, glm::distance(cache.position, p));
        for (const std::uint32_t c : list->cache)
            if (glm::dot(skin.caches[c].normal, n) > 0.9f)
                listed = std::min(listed, glm::distance(skin.caches[c].position, p));
        EXPECT_EQ(listed, nearest);
    }
}

TEST(SkinCaches, MoveWithTheirObjectsWithoutBeingMadeAgain) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box({-3, 0, -3}, {3, 4, 3}, true));
    const std::uint32_t ball = b.addMesh(simple::sphere(0.5f, 2, false));
    b.addInstance(ball, glm::translate(glm::mat4(1), glm::vec3(1, 1, 1)), true);
    Scene scene = b.build();
    MeshSkins skins;
    const SkinLayout layout{0.05f, 0.5f, false};
    const LightCaches before = skins.place(scene, layout);
    EXPECT_EQ(skins.made(), 2U);
    scene.instances[1].toWorld[3] += glm::vec4(0.5f, 0.25f, -1, 0);
    const LightCaches after = skins.place(scene, layout);
    EXPECT_EQ(skins.made(), 0U);
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t c = 0; c < before.size(); ++c) {
        const glm::vec3 moved = before.instance[c] == 1 ? glm::vec3(0.5f, 0.25f, -1) : glm::vec3(0);
        EXPECT_LT(glm::distance(after.position[c], before.position[c] + moved), 1e-5f);
        EXPECT_EQ(after.normal[c], before.normal[c]);
        EXPECT_EQ(after.area[c], before.area[c]);
    }
}

// The caches of an instance twice as large are those of half the distance, so that they are as
// dense in the world.
TEST(SkinCaches, AreAsDenseOnScaledAndMirroredInstances) {
    const auto count = [](const glm::mat4& toWorld, double& area) {
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.5f)));
        b.add(simple::box({-3, -3, -3}, {3, 3, 3}, true));
        b.add(simple::sphere(1, 3, false), toWorld);
        MeshSkins skins;
        const LightCaches caches = skins.place(b.build(), {0.02f, 0.5f, false});
        std::size_t found = 0;
        area = 0;
        for (std::size_t c = 0; c < caches.size(); ++c)
            if (caches.instance[c] == 1) {
                ++found;
                area += double(caches.area[c]);
                EXPECT_GT(glm::dot(caches.normal[c], caches.position[c]), 0) << "outwards";
            }
        return double(found);
    };
    double area = 0;
    const double one = count(glm::mat4(1), area);
    const double ofOne = area;
    const double four = count(glm::scale(glm::mat4(1), glm::vec3(2)), area);
    EXPECT_NEAR(area / ofOne, 4, 1e-3);
    EXPECT_NEAR(four / one, 4, 0.6);
    EXPECT_EQ(count(glm::scale(glm::mat4(1), glm::vec3(-1, 1, 1)), area), one);
    EXPECT_NEAR(area / ofOne, 1, 1e-3);
}

} // namespace
} // namespace limn::skin_caches_test
