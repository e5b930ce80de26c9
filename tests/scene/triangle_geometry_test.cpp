// SPDX-License-Identifier: MIT
#include "engine/scene/mesh/triangle_geometry.h"

#include <gtest/gtest.h>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::triangle_geometry_test {
namespace {

Mesh triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    Mesh m;
    m.positions = {a, b, c};
    m.indices = {0, 1, 2};
    return m;
}

TEST(TriangleGeometry, KnowsAreaAndNormalOfTheSmallestNeedles) {
    for (const float length : {1.f, 1e-4f, 1e-8f}) {
        const float height = 1e-6f * length; // its square and the area's are no floats
        const Mesh needle = triangle({0, 0, 0}, {length, 0, 0}, {0, height, 0});
        const float area = 0.5f * length * height;
        EXPECT_NEAR(triangleArea(needle, 0) / area, 1, 1e-6);
        EXPECT_NEAR(triangleGeometry(needle).area[0] / area, 1, 1e-6);
        EXPECT_EQ(triangleNormal(needle, 0), glm::vec3(0, 0, 1));
        EXPECT_EQ(triangleGeometry(needle).normal[0], glm::vec3(0, 0, 1));
    }
}

TEST(TriangleGeometry, KnowsAreasInTheWorldAtAnyScale) {
    const Mesh mesh = triangle({0, 0, 0}, {1, 0, 0}, {0, 1e-6f, 0});
    Scene scene;
    auto assets = std::make_shared<Assets>();
    assets->meshes = {mesh};
    scene.assets = assets;
    Instance instance;
    for (const int exponent : {-40, -26, 0, 20}) {
        const double s = std::ldexp(1.0, exponent);
        instance.toWorld = glm::scale(glm::mat4(1), glm::vec3(float(s)));
        EXPECT_NEAR(worldArea(scene, instance) / (s * s * 0.5e-6), 1, 1e-6) << exponent;
        EXPECT_NEAR(double(triangleWorldArea(scene, instance, 0)) / (s * s * 0.5e-6), 1, 1e-6)
            << exponent;
    }
}

} // namespace
} // namespace limn::triangle_geometry_test
