// SPDX-License-Identifier: MIT
#include "engine/shading/passed_ray.h"

#include "engine/scene/surface/dielectric.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace limn::passed_ray_test {

using namespace simple;

namespace {

Material glass(float thickness, glm::vec3 tint = glm::vec3(1)) {
    Material m = lambert(tint);
    m.transmission = 1;
    m.thickness = thickness;
    m.roughness = 0;
    return m;
}

/// A scene of one mesh of glass.
Scene sceneOf(const Material& material, Mesh mesh) {
    SceneBuilder b;
    b.addMaterial(material);
    b.add(std::move(mesh));
    return b.build();
}

Mesh pane() {
    return quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
}

/// A direction that goes down at this angle to the vertical.
glm::vec3 downAt(float angle) {
    return {std::sin(angle), -std::cos(angle), 0};
}

/// The ray behind `crossings` transmissive surfaces, with the product of the weights.
PassedRay behind(const TraceScene& trace, Ray ray, int crossings, float pick = 0.99f) {
    PassedRay passed{ray, glm::vec3(1)};
    for (int i = 0; i < crossings; ++i) {
        const Hit hit = trace.closestHit(passed.ray, TraceMask::Seen);
        if (!hit)
            return {};
        const glm::vec3 weight = passed.weight;
        passed = passRay(trace, hit, passed.ray, pick, {0.3f, 0.6f});
        passed.weight *= weight;
    }
    return passed;
}

TEST(PassedRay, GoesStraightThroughAThinSheetFromEitherSide) {
    const Scene scene = sceneOf(glass(0, {0.8f, 0.5f, 0.2f}), pane());
    const TraceScene trace(scene);
    for (const float side : {1.f, -1.f}) {
        const glm::vec3 direction = side * downAt(1);
        const PassedRay passed = behind(trace, {-2.f * direction, direction}, 1);
        EXPECT_LT(glm::length(passed.ray.direction - direction), 1e-5f);
        const float transmitted = 1 - fresnelDielectric(std::cos(1.f), 1.5f);
        EXPECT_NEAR(passed.weight.x, 0.8f * transmitted, 1e-5f);
        EXPECT_NEAR(passed.weight.z, 0.2f * transmitted, 1e-5f);
        EXPECT_FALSE(trace.closestHit(passed.ray, TraceMask::Seen))
            << "it must not meet the sheet again";
    }
}

TEST(PassedRay, IsDisplacedByAPlateOfGlass) {
    const float height = 0.5f;
    const Scene scene = sceneOf(glass(1), box({-5, 0, -5}, {5, height, 5}, false));
    const TraceScene trace(scene);
    const glm::vec3 direction = downAt(0.8f);
    const PassedRay passed = behind(trace, {-3.f * direction, direction}, 2);
    EXPECT_LT(glm::length(passed.ray.direction - direction), 1e-5f);
    const float inside = std::asin(std::sin(0.8f) / 1.5f);
    const float displacement = height * std::sin(0.8f - inside) / std::cos(inside);
    const glm::vec3 across = glm::cross(direction, passed.ray.origin);
    EXPECT_NEAR(glm::length(across), displacement, 1e-4f);
    EXPECT_NEAR(passed.weight.x, 1 - fresnelDielectric(std::cos(0.8f), 1.5f), 1e-5f)
        << "within the body, the share is a probability";
}

// A ball of glass gathers rays near its axis at n R / (2 (n - 1)) from its middle.
TEST(PassedRay, MeetsTheFocusOfABall) {
    const float R = 1, n = 1.5f;
    const Scene scene = sceneOf(glass(1), sphere(R, 5, false));
    const TraceScene trace(scene);
    const PassedRay passed = behind(trace, {{0.05f, 5, 0.02f}, {0, -1, 0}}, 2);
    ASSERT_GT(passed.weight.x, 0.9f);
    const float t = -passed.ray.origin.x / passed.ray.direction.x;
    EXPECT_NEAR(passed.ray.origin.y + t * passed.ray.direction.y, -n * R / (2 * (n - 1)), 0.02f);
}

TEST(PassedRay, IsMirroredWithinABodyByTheShareOfFresnel) {
    const Scene scene = sceneOf(glass(1), box({-5, 0, -5}, {5, 1, 5}, false));
    const TraceScene trace(scene);
    const Ray up{{0, 0.5f, 0}, {0, 1, 0}};
    const PassedRay mirrored = behind(trace, up, 1, 0.039f), out = behind(trace, up, 1, 0.041f);
    EXPECT_NEAR(mirrored.ray.direction.y, -1, 1e-6f);
    EXPECT_NEAR(out.ray.direction.y, 1, 1e-6f);
    EXPECT_EQ(mirrored.weight, glm::vec3(1));
    EXPECT_EQ(out.weight, glm::vec3(1));
    // Beyond the critical angle of 41.8 degrees all light stays.
    const Ray slanted{{0, 0.5f, 0}, -downAt(0.75f)};
    EXPECT_LT(behind(trace, slanted, 1, 0.9999f).ray.direction.y, 0);
}

TEST(PassedRay, EndsAtOpaqueSurfacesAndMetals) {
    Material opaque = lambert(glm::vec3(0.5f));
    const Scene wall = sceneOf(opaque, pane());
    EXPECT_EQ(behind(TraceScene(wall), {{0, 1, 0}, {0, -1, 0}}, 1).weight, glm::vec3(0));
    Material metal = glass(0);
    metal.metallic = 1;
    const Scene mirror = sceneOf(metal, pane());
    EXPECT_EQ(behind(TraceScene(mirror), {{0, 1, 0}, {0, -1, 0}}, 1).weight, glm::vec3(0));
}

// Facets of a rough sheet turn light aside, evenly about where it went.
TEST(PassedRay, IsScatteredByARoughSheetAboutItsDirection) {
    Material frosted = glass(0);
    frosted.roughness = 0.4f;
    const Scene scene = sceneOf(frosted, pane());
    const TraceScene trace(scene);
    const Ray ray{{0, 1, 0}, {0, -1, 0}};
    const Hit hit = trace.closestHit(ray, TraceMask::Seen);
    glm::vec3 mean(0);
    constexpr int kSteps = 64;
    float least = 1;
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const glm::vec2 u((float(i % kSteps) + 0.5f) / kSteps, (float(i / kSteps) + 0.5f) / kSteps);
        const PassedRay passed = passRay(trace, hit, ray, 0.5f, u);
        mean += passed.ray.direction * passed.weight;
        least = std::min(least, -passed.ray.direction.y);
    }
    mean /= float(kSteps * kSteps);
    EXPECT_NEAR(mean.x, 0, 1e-3f);
    EXPECT_NEAR(mean.z, 0, 1e-3f);
    EXPECT_LT(mean.y, -0.8f);
    EXPECT_LT(least, 0.7f);
}

} // namespace
} // namespace limn::passed_ray_test
