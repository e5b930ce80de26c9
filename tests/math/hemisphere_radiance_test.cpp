// SPDX-License-Identifier: MIT
#include "engine/math/hemisphere_radiance.h"

#include "engine/math/sh.h"
#include "engine/shading/sampler.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn::hemisphere_radiance_test {
namespace {

constexpr float kPi = glm::pi<float>();
using Coefficients = std::array<double, 9>;

/// Direction at height z above n, with the given azimuth.
glm::vec3 directionAt(glm::vec3 n, float z, float azimuth) {
    return directionAbout(n, std::sqrt(1 - z * z), z, azimuth / (2 * kPi));
}

/// Harmonics of light from above n, by the midpoint rule.
Coefficients harmonicsOf(glm::vec3 n, const std::function<float(glm::vec3)>& radiance) {
    constexpr int kHeights = 400, kAzimuths = 64;
    Coefficients c{};
    for (int i = 0; i < kHeights; ++i)
        for (int j = 0; j < kAzimuths; ++j) {
            const glm::vec3 d = directionAt(n, (float(i) + 0.5f) / kHeights,
                                            2 * kPi * (float(j) + 0.5f) / kAzimuths);
            float y[9];
            shBasis(3, d, y);
            for (std::size_t k = 0; k < 9; ++k)
                c[k] += double(radiance(d) * y[k]) * 2 * double(kPi) / (kHeights * kAzimuths);
        }
    return c;
}

double estimate(int bands, glm::vec3 n, glm::vec3 d, const Coefficients& c) {
    float w[9];
    hemisphereRadianceWeights(bands, n, d, w);
    double sum = 0;
    for (std::size_t i = 0; i < std::size_t(bands * bands); ++i)
        sum += double(w[i]) * c[i];
    return sum;
}

const std::array kNormals = {glm::vec3(0, 1, 0), glm::normalize(glm::vec3(1, -2, 0.5f)),
                             glm::normalize(glm::vec3(-0.3f, 0.2f, -1))};

TEST(HemisphereRadiance, IsExactForLightThatIsLinearInItsDirection) {
    const glm::vec3 slope(0.4f, -0.2f, 0.7f);
    const auto radiance = [&](glm::vec3 d) { return 1.5f + glm::dot(slope, d); };
    for (const glm::vec3 n : kNormals) {
        const Coefficients c = harmonicsOf(n, radiance);
        for (const int bands : {2, 3})
            for (const float z : {0.05f, 0.3f, 0.6f, 0.95f})
                for (const float azimuth : {0.f, 2.f, 4.f}) {
                    const glm::vec3 d = directionAt(n, z, azimuth);
                    EXPECT_NEAR(estimate(bands, n, d, c), double(radiance(d)), 1e-4) << bands;
                }
    }
}

TEST(HemisphereRadiance, KeepsTheIrradianceOfAnyLight) {
    // The mean over the hemisphere, weighted by cosines, is irradiance over pi where two bands
    // hold the light; a third band may add its own cosine part.
    const auto radiance = [](glm::vec3 d) { return d.x > 0.2f ? 3.f : 0.5f; };
    for (const glm::vec3 n : kNormals) {
        const Coefficients c = harmonicsOf(n, radiance);
        double mean = 0, flux = 0;
        constexpr int kSteps = 64;
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                const float z = std::sqrt((float(i) + 0.5f) / kSteps);
                const glm::vec3 d = directionAt(n, z, 2 * kPi * (float(j) + 0.5f) / kSteps);
                mean += estimate(2, n, d, c) / (kSteps * kSteps);
                flux += double(radiance(d)) / (kSteps * kSteps);
            }
        EXPECT_NEAR(mean, flux, 0.005 * flux);
    }
}

TEST(HemisphereRadiance, AThirdBandIsNearerToLightFromOneSide) {
    const glm::vec3 n(0, 0, 1), side = glm::normalize(glm::vec3(0, 1, 1));
    const auto radiance = [&](glm::vec3 d) { return std::exp(4 * (glm::dot(d, side) - 1)); };
    const Coefficients c = harmonicsOf(n, radiance);
    double two = 0, three = 0;
    for (const float z : {0.1f, 0.3f, 0.5f, 0.7f, 0.9f})
        for (float azimuth = 0; azimuth < 6.2f; azimuth += 0.5f) {
            const glm::vec3 d = directionAt(n, z, azimuth);
            const double truth = double(radiance(d));
            two += std::pow(estimate(2, n, d, c) - truth, 2);
            three += std::pow(estimate(3, n, d, c) - truth, 2);
        }
    EXPECT_LT(three, 0.75 * two);
}

} // namespace
} // namespace limn::hemisphere_radiance_test
