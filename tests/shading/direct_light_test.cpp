// SPDX-License-Identifier: MIT
// Direct light as harmonics, against what closed forms say of light limited to some bands.
#include "engine/shading/direct_light.h"

#include "engine/math/sh.h"
#include "tests/shading/light_formulas.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace limn::direct_light_test {
namespace {

using namespace simple;

constexpr double kPi = std::numbers::pi;

/// Irradiance from light of unit irradiance out of one direction, limited to some bands, on a plane
/// whose normal is at that cosine to it: the sum of A_l (2l + 1) / (4 pi) P_l.
double limitedCosine(int bands, double cosine) {
    const std::array<double, 3> a = {kPi, 2 * kPi / 3, kPi / 4};
    const std::array<double, 3> p = {1, cosine, 1.5 * cosine * cosine - 0.5};
    double sum = 0;
    for (int l = 0; l < bands; ++l)
        sum += a[std::size_t(l)] * (2 * l + 1) / (4 * kPi) * p[std::size_t(l)];
    return sum;
}

struct Floor {
    explicit Floor(const Light& light) : scene(made(light)), trace(scene) {}

    static Scene made(const Light& light) {
        SceneBuilder b;
        b.addMaterial(lambert(glm::vec3(0.5f)));
        b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
        b.add(quad({4, 0, -1}, {0, 0, 2}, {0, 2, 0})); // a wall that shadows what lies beyond
        b.scene.lights = {light};
        return b.build();
    }
    SurfacePoint at(float x, glm::vec3 normal = {0, 1, 0}) const {
        return {.position = {x, 0, 0}, .geometricNormal = {0, 1, 0}, .normal = normal};
    }
    std::array<glm::vec3, 9> harmonics(const SurfacePoint& p, int bands) const {
        std::array<glm::vec3, 9> c{};
        std::uint64_t rays = 0;
        addDirectHarmonics(trace, p, bands, c.data(), rays);
        return c;
    }
    Scene scene;
    TraceScene trace;
};

TEST(DirectHarmonics, OfAPointLightAreThatOfItsDirection) {
    const Floor floor(Light{.position = {1, 2, 0.5f}, .color = {1, 2, 3}, .strength = 10});
    for (const float x : {0.f, 2.f, 3.5f})
        for (const int bands : {2, 3}) {
            const glm::vec3 way = glm::vec3(1, 2, 0.5f) - glm::vec3(x, 0, 0);
            const double d2 = double(glm::dot(way, way)), cosine = 2 / std::sqrt(d2);
            const auto c = floor.harmonics(floor.at(x), bands);
            const glm::vec3 e = shIrradiance(bands, c.data(), {0, 1, 0});
            const double expected = 10 / d2 * limitedCosine(bands, cosine);
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(e[k], expected * (k + 1), 1e-4 * expected) << bands;
        }
}

TEST(DirectHarmonics, OfASunAtATiltedNormal) {
    const glm::vec3 toSun = glm::normalize(glm::vec3(0.3f, 1, -0.2f));
    const Floor floor(Light{.kind = LightKind::Directional, .direction = -toSun, .strength = 4});
    const glm::vec3 normal = glm::normalize(glm::vec3(-0.5f, 1, 0.4f));
    const auto c = floor.harmonics(floor.at(0), 3);
    const double expected = 4 * limitedCosine(3, double(glm::dot(normal, toSun)));
    EXPECT_NEAR(shIrradiance(3, c.data(), normal).x, expected, 1e-4 * expected);
}

TEST(DirectHarmonics, AreDarkInShadowAndBelowTheSurface) {
    const Floor floor(Light{.position = {0, 1, 0}, .strength = 10});
    EXPECT_GT(floor.harmonics(floor.at(3.9f), 3)[0].x, 0);
    EXPECT_EQ(floor.harmonics(floor.at(4.5f), 3)[0].x, 0);
    const Floor below(Light{.position = {0, -1, 0}, .strength = 10});
    EXPECT_EQ(below.harmonics(below.at(0), 3)[0].x, 0);
}

// Of a polygon of constant radiance L, band 0 has its solid angle and band 1 its vector irradiance,
// which is Lambert's formula along each axis.
TEST(DirectHarmonics, OfARectangleHaveItsSolidAngleAndVectorIrradiance) {
    Light panel{.kind = LightKind::Rectangle, .position = {0, 2, 0}, .strength = 3};
    panel.direction = {0, -1, 0};
    panel.size = {1.5f, 1};
    const Floor floor(panel);
    const auto c = floor.harmonics(floor.at(0), 2);
    const double a = 0.75, b = 0.5, d = 2;
    const double omega = 4 * std::asin(a * b / std::sqrt((a * a + d * d) * (b * b + d * d)));
    EXPECT_NEAR(c[0].x, 3 * omega * std::sqrt(1 / (4 * kPi)), 1e-3 * double(c[0].x));
    const double up = formulas::polygonIrradiance(formulas::cornersOf(panel, {0, 0, 0}), {0, 1, 0});
    EXPECT_NEAR(c[1].x, 3 * up * std::sqrt(3 / (4 * kPi)), 1e-3 * double(c[1].x));
    EXPECT_NEAR(c[3].x, 0, 1e-3 * double(c[1].x));
    panel.enabled = false;
    const Floor off(panel);
    EXPECT_EQ(off.harmonics(off.at(0), 2)[0].x, 0);
}

} // namespace
} // namespace limn::direct_light_test
