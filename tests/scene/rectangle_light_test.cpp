// SPDX-License-Identifier: MIT
#include "engine/scene/light/rectangle_light.h"

#include <cmath>
#include <limits>
#include <random>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace limn::rectangle_light_test {
namespace {

constexpr double kPi = glm::pi<double>();

/// Shines straight down from `height` above the origin; its width lies along +X.
Light panel(float width, float depth, float height) {
    Light light;
    light.kind = LightKind::Rectangle;
    light.position = {0, height, 0};
    light.direction = {0, -1, 0};
    light.size = {width, depth};
    return light;
}

/// Share of the hemisphere's cosine that a rectangle a x b takes, parallel to a small surface at
/// distance h under its corner. Hottel. Radiant Heat Transmission. 1931
double cornerFormFactor(double a, double b, double h) {
    const double X = a / h, Y = b / h, x = std::sqrt(1 + X * X), y = std::sqrt(1 + Y * Y);
    return (X / x * std::atan(Y / x) + Y / y * std::atan(X / y)) / (2 * kPi);
}

struct Random {
    std::mt19937 generator{5};
    float unit() { return std::uniform_real_distribution<float>(0, 1)(generator); }
    glm::vec3 direction() {
        std::normal_distribution<float> normal;
        return glm::normalize(glm::vec3(normal(generator), normal(generator), normal(generator)));
    }
};

TEST(RectangleLight, LiesLevelAndTurnsAboutItsDirection) {
    Light light = panel(2, 1, 3);
    LightRectangle r = lightRectangle(light);
    EXPECT_EQ(r.halfWidth, glm::vec3(1, 0, 0));
    EXPECT_NEAR(std::abs(r.halfHeight.z), 0.5f, 1e-6f);
    EXPECT_EQ(r.area, 2);
    light.roll = glm::half_pi<float>();
    r = lightRectangle(light);
    EXPECT_NEAR(std::abs(r.halfWidth.z), 1, 1e-6f);
    EXPECT_NEAR(std::abs(r.halfHeight.x), 0.5f, 1e-6f);
    Random random;
    for (int i = 0; i < 100; ++i) {
        light.direction = random.direction();
        light.roll = 0;
        r = lightRectangle(light);
        EXPECT_NEAR(r.halfWidth.y, 0, 1e-6f);
        light.roll = 7 * random.unit();
        r = lightRectangle(light);
        EXPECT_NEAR(glm::length(r.halfWidth), 1, 1e-5f);
        EXPECT_NEAR(glm::length(r.halfHeight), 0.5f, 1e-5f);
        EXPECT_NEAR(glm::dot(r.halfWidth, r.halfHeight), 0, 1e-5f);
        EXPECT_NEAR(glm::dot(r.halfWidth, r.normal), 0, 1e-5f);
        EXPECT_NEAR(glm::dot(r.halfHeight, r.normal), 0, 1e-5f);
    }
}

TEST(RectangleLight, OverItsCornerIsTheClosedForm) {
    for (const float a : {0.01f, 1.f, 40.f})
        for (const float b : {0.5f, 3.f})
            for (const float h : {0.02f, 1.f, 7.f}) {
                const LightRectangle r = lightRectangle(panel(a, b, h));
                const double expected = kPi * cornerFormFactor(double(a), double(b), double(h));
                for (const float sx : {-1.f, 1.f})
                    for (const float sz : {-1.f, 1.f})
                        EXPECT_NEAR(
                            double(rectangleIrradiance(r, {sx * a / 2, 0, sz * b / 2}, {0, 1, 0})),
                            expected, 1e-5 * expected)
                            << a << " x " << b << " at " << h;
            }
}

TEST(RectangleLight, FarAwayIsRadianceTimesAreaTimesBothCosinesOverDistanceSquared) {
    const Light light = panel(0.3f, 0.2f, 0);
    const LightRectangle r = lightRectangle(light);
    const glm::vec3 way = glm::normalize(glm::vec3(0.4f, -1, 0.3f));
    const glm::vec3 n = glm::normalize(glm::vec3(-0.2f, 1, 0.4f));
    // 0.3 * 0.2 cos cos' / d^2; the error falls as (size / d)^2. From 1e5 sizes on it is a point.
    for (const double d : {30.0, 1e3, 2e4, 1e5, 1e7}) {
        const double expected = 0.06 * double(glm::dot(n, -way)) * double(-way.y) / (d * d);
        EXPECT_NEAR(double(rectangleIrradiance(r, way * float(d), n)), expected,
                    (1e-5 + 0.1 / (d * d)) * expected)
            << d;
    }
}

TEST(RectangleLight, AnInfiniteOneIsHalfOfAWhiteSphere) {
    const LightRectangle r = lightRectangle(panel(kMaxLightSize, kMaxLightSize, 2));
    EXPECT_NEAR(double(rectangleIrradiance(r, {}, {0, 1, 0})), kPi, 1e-5);
    // A plane overhead lights a tilted surface by the lune above its horizon: pi (1 + cos) / 2.
    for (const double tilt : {0.3, 1.0, 1.5, 2.5})
        EXPECT_NEAR(
            double(rectangleIrradiance(r, {}, {float(std::sin(tilt)), float(std::cos(tilt)), 0})),
            kPi * (1 + std::cos(tilt)) / 2, 1e-5)
            << tilt;
}

TEST(RectangleLight, IsTheMeanOfItsPointsAlsoAcrossTheHorizon) {
    Random random;
    int cut = 0;
    for (int round = 0; round < 60; ++round) {
        Light light = panel(0.2f + 2 * random.unit(), 0.2f + 2 * random.unit(), 0);
        light.direction = random.direction();
        light.roll = 6 * random.unit();
        const LightRectangle r = lightRectangle(light);
        const glm::vec3 p = r.normal * (0.4f + random.unit()) + 0.7f * random.direction();
        const glm::vec3 n = random.direction();
        if (glm::dot(p, r.normal) < 0.2f)
            continue; // nearly in its plane: the sum below is too coarse
        constexpr int kCells = 300;
        double sum = 0;
        int below = 0;
        for (int y = 0; y < kCells; ++y)
            for (int x = 0; x < kCells; ++x) {
                const glm::vec3 q = r.at({(float(x) + 0.5f) / kCells, (float(y) + 0.5f) / kCells});
                sum += double(pointIrradiance(r, q, p, n));
                below += glm::dot(q - p, n) < 0;
            }
        cut += below > 0 && below < kCells * kCells;
        const double expected = sum * double(r.area) / (kCells * kCells);
        EXPECT_NEAR(double(rectangleIrradiance(r, p, n)), expected, 2e-4 * expected + 2e-5)
            << round;
    }
    EXPECT_GT(cut, 10);
}

TEST(RectangleLight, NothingComesFromBehindItOrBelowTheHorizon) {
    const LightRectangle r = lightRectangle(panel(1, 1, 2));
    EXPECT_EQ(rectangleIrradiance(r, {0, 2.5f, 0}, {0, -1, 0}), 0);
    EXPECT_EQ(rectangleIrradiance(r, {0, 2, 0}, {0, 1, 0}), 0);
    EXPECT_EQ(rectangleIrradiance(r, {5, 2, 0}, {-1, 0, 0}), 0);
    EXPECT_EQ(rectangleIrradiance(r, {}, {0, -1, 0}), 0);
    EXPECT_GT(rectangleIrradiance(r, {}, {1, 0, 0}), 0);
}

TEST(RectangleLight, AtContactEdgeOnTinyOrHugeItIsANumberInRange) {
    const float inf = std::numeric_limits<float>::infinity();
    for (const float size : {kMinLightSize, 1e-3f, 1.f, 1e3f, kMaxLightSize})
        for (const float other : {kMinLightSize, 1.f, kMaxLightSize})
            for (const float height : {0.f, 1e-30f, 1e-7f, 1.f, 1e6f, 1e30f}) {
                const LightRectangle r = lightRectangle(panel(size, other, 0));
                for (const float x : {0.f, size / 2, -size / 2, size, 1e30f})
                    for (const float z : {0.f, other / 2})
                        for (const glm::vec3 n :
                             {glm::vec3(0, 1, 0), glm::vec3(1, 0, 0), glm::vec3(0, 0, -1),
                              glm::normalize(glm::vec3(1, 1e-6f, 0))}) {
                            const float E = rectangleIrradiance(r, {x, -height, z}, n);
                            EXPECT_TRUE(E >= 0 && E <= float(kPi))
                                << E << " of " << size << " x " << other << " at " << x << ", "
                                << -height << ", " << z;
                            EXPECT_LT(pointIrradiance(r, {}, {x, -height, z}, n), inf);
                        }
            }
    // Just under the middle it fills the sky.
    EXPECT_NEAR(double(rectangleIrradiance(lightRectangle(panel(1, 1, 1e-5f)), {}, {0, 1, 0})), kPi,
                1e-3);
}

TEST(SphericalRectangle, PlacesAreEvenInSolidAngle) {
    Random random;
    for (int k = 0; k < 200; ++k) {
        Light light =
            panel(std::exp2(12 * random.unit() - 6), std::exp2(12 * random.unit() - 6), 1);
        light.direction = random.direction();
        light.position = (0.1f + 3 * random.unit()) * random.direction();
        if (glm::dot(light.position, light.direction) > 0) // it would shine the other way
            light.position = -light.position;
        const LightRectangle r = lightRectangle(light);
        const glm::vec3 n = glm::normalize(r.centre);
        const SphericalRectangle sphere(r, glm::vec3(0));
        // The mean cosine over the solid angle is Lambert's irradiance; n² of them sum it to 1/n².
        constexpr int kSide = 128;
        double sum = 0;
        for (int j = 0; j < kSide; ++j)
            for (int i = 0; i < kSide; ++i) {
                const glm::vec3 at =
                    sphere.at((glm::vec2(float(i), float(j)) + 0.5f) / float(kSide));
                EXPECT_LE(std::abs(glm::dot(at - r.centre, r.normal)), 1e-4f * glm::length(at));
                sum += std::max(double(glm::dot(glm::normalize(at), n)), 0.);
            }
        const double expected = double(rectangleIrradiance(r, glm::vec3(0), n));
        EXPECT_NEAR(sum / (kSide * kSide) * sphere.solidAngle(), expected, 2e-3 * expected) << k;
    }
}

TEST(SphericalRectangle, FromFarAwayItIsItsAreaOverTheSquaredDistance) {
    for (const float distance : {1e3f, 1e4f, 1e6f}) {
        const LightRectangle r = lightRectangle(panel(2, 1, distance));
        const SphericalRectangle sphere(r, glm::vec3(0));
        const double expected = 2 / (double(distance) * distance);
        EXPECT_NEAR(sphere.solidAngle(), expected, 1e-4 * expected);
        EXPECT_LT(glm::length(sphere.at({0, 0}) - r.at({0, 0})), 2.1f);
        for (const glm::vec2 uv : {glm::vec2(0), glm::vec2(0.3f, 0.9f), glm::vec2(1)})
            EXPECT_LE(std::abs(sphere.at(uv).x), 1.0001f);
    }
}

} // namespace
} // namespace limn::rectangle_light_test
