// SPDX-License-Identifier: MIT
#include "engine/math/horizon.h"

#include "engine/math/sh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn::horizon_test {
namespace {

constexpr float kPi = glm::pi<float>();
using Coefficients = std::array<float, 4>;

const std::array kNormals = {glm::vec3(0, 1, 0), glm::normalize(glm::vec3(1, -2, 0.5f)),
                             glm::normalize(glm::vec3(-0.3f, 0.2f, -1))};
constexpr std::array kLights = {Coefficients{1, 0.2f, -0.4f, 0.7f}, Coefficients{0.3f, 0, 0, 0},
                                Coefficients{2, -1, 0.5f, 0.1f}};

/// Irradiance over the first two bands.
float irradianceOn(glm::vec3 n, const Coefficients& c) {
    std::array<glm::vec3, 4> grey;
    for (std::size_t i = 0; i < 4; ++i)
        grey[i] = glm::vec3(c[i]);
    return shIrradiance(2, grey.data(), n).x;
}

/// Harmonics of light of radiance a + b d.n above the plane, and of nothing below it: M0 = 2 pi a +
/// pi b, M1.n = pi a + 2 pi/3 b.
Coefficients above(glm::vec3 n, float a, float b) {
    const float m0 = kPi * (2 * a + b), m1 = kPi * (a + b * 2 / 3);
    const float k0 = std::sqrt(1 / (4 * kPi)), k1 = std::sqrt(3 / (4 * kPi));
    return {k0 * m0, k1 * m1 * n.y, k1 * m1 * n.z, k1 * m1 * n.x};
}

TEST(Horizon, EvenLightBecomesEvenInAllDirections) {
    for (const glm::vec3 n : kNormals) {
        Coefficients c = above(n, 3, 0);
        continueBelow(n, c.data());
        for (const glm::vec3 other : kNormals)
            EXPECT_NEAR(irradianceOn(other, c), 3 * kPi, 1e-5f);
    }
}

TEST(Horizon, TheRadianceBelowIsThatAtAQuarterOfTheHeight) {
    for (const glm::vec3 n : kNormals)
        for (const float slope : {-1.f, 0.f, 0.5f, 4.f}) {
            const Coefficients c = above(n, 2, slope);
            EXPECT_NEAR(horizonRadiance(n, c.data()), 2 + slope / 4, 1e-5f) << slope;
        }
}

TEST(Horizon, IrradianceOnThePlaneStays) {
    for (const glm::vec3 n : kNormals)
        for (const Coefficients& light : kLights) {
            Coefficients c = light;
            continueBelow(n, c.data());
            EXPECT_NEAR(irradianceOn(n, c), irradianceOn(n, light), 1e-5f);
        }
}

TEST(Horizon, CuttingOffUndoesIt) {
    for (const glm::vec3 n : kNormals)
        for (const Coefficients& light : kLights) {
            Coefficients c = light;
            continueBelow(n, c.data());
            cutBelow(n, c.data());
            for (std::size_t i = 0; i < 4; ++i)
                EXPECT_NEAR(c[i], light[i], 1e-5f);
        }
}

TEST(Horizon, WeightsGiveTheSameSums) {
    const auto sum = [](const Coefficients& w, const Coefficients& c) {
        return w[0] * c[0] + w[1] * c[1] + w[2] * c[2] + w[3] * c[3];
    };
    for (const glm::vec3 n : kNormals)
        for (const Coefficients& light : kLights) {
            const Coefficients weights{0.4f, -0.3f, 1.5f, 0.2f};
            Coefficients c = light, w = weights;
            continueBelow(n, c.data());
            weighContinued(n, w.data());
            EXPECT_NEAR(sum(w, light), sum(weights, c), 1e-5f);
            c = light, w = weights;
            cutBelow(n, c.data());
            weighCut(n, w.data());
            EXPECT_NEAR(sum(w, light), sum(weights, c), 1e-5f);
        }
}

} // namespace
} // namespace limn::horizon_test
