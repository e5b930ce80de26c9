// SPDX-License-Identifier: MIT
#include "engine/math/sh.h"

#include "engine/math/cone.h"
#include "engine/math/sampling.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace limn::sh_test {
namespace {

constexpr double kPi = std::numbers::pi;

glm::vec3 someDirection(unsigned i) {
    const DirectionSet set(64, true, 7);
    return set[i % 64];
}

/// Gauss-like quadrature of f over [a, b]: composite Simpson in double.
template <class F>
double integrate(F f, double a, double b, int steps = 4000) {
    const double h = (b - a) / (2 * steps);
    double sum = f(a) + f(b);
    for (int i = 1; i < 2 * steps; ++i)
        sum += f(a + i * h) * (i % 2 ? 4 : 2);
    return sum * h / 3;
}

TEST(Sh, BasisIsOrthonormalUpToEightBands) {
    // Product of Gauss-free rules: equidistant in phi (exact for trigonometric polynomials),
    // Simpson in z.
    const int phiSteps = 32;
    std::vector<double> gram(kMaxCoefficients * kMaxCoefficients);
    const int zSteps = 400;
    for (int zi = 0; zi <= zSteps; ++zi) {
        const double z = -1 + 2.0 * zi / zSteps;
        const double weight = (zi == 0 || zi == zSteps ? 1 : zi % 2 ? 4 : 2) * (2.0 / zSteps) / 3;
        for (int p = 0; p < phiSteps; ++p) {
            const double phi = 2 * kPi * p / phiSteps, r = std::sqrt(std::max(0.0, 1 - z * z));
            float y[kMaxCoefficients];
            shBasis(kMaxBands, {float(r * std::cos(phi)), float(r * std::sin(phi)), float(z)}, y);
            for (int i = 0; i < kMaxCoefficients; ++i)
                for (int j = 0; j < kMaxCoefficients; ++j)
                    gram[std::size_t(i * kMaxCoefficients + j)] +=
                        double(y[i]) * y[j] * weight * 2 * kPi / phiSteps;
        }
    }
    for (int i = 0; i < kMaxCoefficients; ++i)
        for (int j = 0; j < kMaxCoefficients; ++j)
            EXPECT_NEAR(gram[std::size_t(i * kMaxCoefficients + j)], i == j ? 1 : 0, 2e-4)
                << i << " " << j;
}

TEST(Sh, FirstBandsHaveTheStatedSignsAndConstants) {
    float y[9];
    const glm::vec3 d = glm::normalize(glm::vec3(0.3f, -0.5f, 0.8f));
    shBasis(3, d, y);
    EXPECT_NEAR(y[0], 0.5 * std::sqrt(1 / kPi), 1e-6);
    EXPECT_NEAR(y[1], std::sqrt(3 / (4 * kPi)) * d.y, 1e-6);
    EXPECT_NEAR(y[2], std::sqrt(3 / (4 * kPi)) * d.z, 1e-6);
    EXPECT_NEAR(y[3], std::sqrt(3 / (4 * kPi)) * d.x, 1e-6);
    EXPECT_NEAR(y[4], std::sqrt(15 / (4 * kPi)) * d.x * d.y, 1e-6);
    EXPECT_NEAR(y[5], std::sqrt(15 / (4 * kPi)) * d.y * d.z, 1e-6);
    EXPECT_NEAR(y[6], std::sqrt(5 / (16 * kPi)) * (3 * d.z * d.z - 1), 1e-6);
    EXPECT_NEAR(y[7], std::sqrt(15 / (4 * kPi)) * d.x * d.z, 1e-6);
    EXPECT_NEAR(y[8], std::sqrt(15 / (16 * kPi)) * (d.x * d.x - d.y * d.y), 1e-6);
}

TEST(Sh, LobeFactorsEqualTheLegendreIntegralOfTheLobe) {
    for (const float n : {1.f, 5.f, 30.f, 100.f}) {
        const auto s = lobeFactors(n);
        for (int l = 0; l < kMaxBands; ++l) {
            const double expected = integrate(
                [&](double x) {
                    return (n + 1) * std::pow(x, double(n)) * std::legendre(unsigned(l), x);
                },
                0, 1);
            EXPECT_NEAR(s[std::size_t(l)], expected, 1e-5) << "n " << n << " l " << l;
        }
    }
}

TEST(Sh, IrradianceFactorsAreTheKnownOnes) {
    const double known[] = {kPi, 2 * kPi / 3, kPi / 4, 0, -kPi / 24, 0, kPi / 64, 0};
    const auto a = irradianceFactors();
    for (int l = 0; l < kMaxBands; ++l)
        EXPECT_NEAR(a[std::size_t(l)], known[l], 1e-6);
}

TEST(Sh, ConstantRadianceGivesPiForEveryNormalAndBandCount) {
    for (int bands = 2; bands <= kMaxBands; ++bands) {
        std::vector<glm::vec3> c(std::size_t(bands * bands), glm::vec3(0));
        c[0] = glm::vec3(float(2 * std::sqrt(kPi)));
        for (unsigned i = 0; i < 64; ++i)
            EXPECT_NEAR(shIrradiance(bands, c.data(), someDirection(i)).x, kPi, 1e-5);
    }
}

TEST(Sh, CosineLobeOfRadianceMatchesItsClosedFormIrradiance) {
    // L(w) = max(0, w.d) seen by the plane n = d: E = integral of cos^2 over the hemisphere = 2 pi
    // / 3.
    const DirectionSet set(20000, true, 3);
    const glm::vec3 d = glm::normalize(glm::vec3(1, 2, -2));
    std::vector<glm::vec3> c(kMaxCoefficients, glm::vec3(0));
    float y[kMaxCoefficients];
    for (unsigned i = 0; i < set.count; ++i) {
        shBasis(kMaxBands, set[i], y);
        for (int k = 0; k < kMaxCoefficients; ++k)
            c[std::size_t(k)] +=
                glm::vec3(std::max(0.f, glm::dot(set[i], d)) * y[k] * set.solidAngle(i));
    }
    EXPECT_NEAR(shIrradiance(kMaxBands, c.data(), d).x, 2 * kPi / 3, 3e-3);
}

TEST(Cone, FactorsEqualTheMeanOfLegendreOverTheCone) {
    for (const double degrees : {0.01, 0.1, 1.0, 10.0, 45.0, 90.0, 120.0, 179.0, 180.0}) {
        const double half = degrees * kPi / 360, u = 2 * std::sin(half) * std::sin(half); // 1 - cos
        float g[kMaxBands];
        coneFactors(kMaxBands, float(u), g);
        for (int l = 0; l < kMaxBands; ++l) {
            // Mean of P_l over the cap, integrated in v = 1 - cos so that small cones keep their
            // digits.
            const double mean =
                integrate([&](double v) { return std::legendre(unsigned(l), 1 - v); }, 0, u, 400) /
                u;
            EXPECT_NEAR(g[l], mean, 4e-6) << degrees << " degrees, l " << l;
        }
    }
}

TEST(Cone, ProjectionEqualsNumericIntegrationOverTheRotatedCone) {
    const glm::vec3 d = glm::normalize(glm::vec3(-1, 0.4f, 0.7f));
    const glm::mat3 toWorld = basisAround(d);
    for (const double degrees : {0.01, 5.0, 40.0, 100.0, 180.0}) {
        const double half = degrees * kPi / 360, u = 2 * std::sin(half) * std::sin(half);
        float g[kMaxBands], axis[kMaxCoefficients], y[kMaxCoefficients];
        coneFactors(kMaxBands, float(u), g);
        shBasis(kMaxBands, d, axis);
        double mean[kMaxCoefficients] = {};
        const int rings = 200, spokes = 32;
        for (int r = 0; r < rings; ++r)
            for (int s = 0; s < spokes; ++s) {
                const double v = u * (r + 0.5) / rings, phi = 2 * kPi * s / spokes;
                const double radius = std::sqrt(v * (2 - v));
                shBasis(kMaxBands,
                        toWorld * glm::vec3(float(radius * std::cos(phi)),
                                            float(radius * std::sin(phi)), float(1 - v)),
                        y);
                for (int i = 0; i < kMaxCoefficients; ++i)
                    mean[i] += y[i] / double(rings * spokes);
            }
        for (int l = 0, i = 0; l < kMaxBands; ++l)
            for (; i < (l + 1) * (l + 1); ++i)
                EXPECT_NEAR(g[l] * axis[i], mean[i], 3e-4) << degrees << " degrees, i " << i;
    }
}

} // namespace
} // namespace limn::sh_test
