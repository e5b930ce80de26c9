// SPDX-License-Identifier: MIT
// Each convention is checked by shading with it as its engine does, in light of one harmonic at a
// time; the expected E / pi comes from the closed form of the cosine lobe's convolution.
#include "engine/export/sh_conventions.h"

#include <cmath>
#include <functional>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::sh_conventions_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Orthonormal harmonics, written out.
std::array<double, 9> basis(const glm::dvec3& n) {
    const double k1 = std::sqrt(3 / (4 * kPi)), k2 = std::sqrt(15 / (4 * kPi));
    return {std::sqrt(1 / (4 * kPi)),
            k1 * n.y,
            k1 * n.z,
            k1 * n.x,
            k2 * n.x * n.y,
            k2 * n.y * n.z,
            std::sqrt(5 / (16 * kPi)) * (3 * n.z * n.z - 1),
            k2 * n.x * n.z,
            k2 / 2 * (n.x * n.x - n.y * n.y)};
}

constexpr std::array<double, 9> kConvolved = {1,    2. / 3, 2. / 3, 2. / 3, 0.25,
                                              0.25, 0.25,   0.25,   0.25}; // A_l / pi

std::vector<glm::dvec3> directions() {
    std::vector<glm::dvec3> d;
    for (int i = 0; i < 60; ++i) {
        const double z = (i + 0.5) / 30 - 1, phi = 2.4 * i, r = std::sqrt(1 - z * z);
        d.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
    }
    return d;
}

/// Compares E / pi by an engine's formula with the closed form, for each harmonic.
void expectsIrradiance(const std::function<double(const Sh3&, const glm::dvec3&)>& shade,
                       std::size_t count = 9) {
    for (std::size_t i = 0; i < count; ++i) {
        Sh3 c{};
        c[0] = glm::vec3(3);
        c[i] = glm::vec3(2);
        for (const glm::dvec3& n : directions()) {
            double expected = 0;
            for (std::size_t k = 0; k < 9; ++k)
                expected += kConvolved[k] * double(c[k].x) * basis(n)[k];
            EXPECT_NEAR(shade(c, n), expected, 1e-6) << "harmonic " << i;
        }
    }
}

/// Babylon.js' harmonics: ours with the sign (-1)^m.
double babylon(const Sh3& h, const glm::dvec3& n) {
    const std::array<double, 9> y = basis(n);
    const std::array<double, 9> sign = {1, -1, 1, -1, 1, -1, 1, -1, 1};
    double sum = 0;
    for (std::size_t i = 0; i < 9; ++i)
        sum += sign[i] * y[i] * double(h[i].x);
    return sum;
}

} // namespace

TEST(ShConventions, ConstantsAreThoseOfTheOrthonormalPolynomials) {
    const std::array<double, 9> y = basis({1, 1, 1}); // polynomials 1, ..., 3z^2-1 = 2, ..., 0
    for (const std::size_t i : {0, 1, 2, 3, 4, 5, 7})
        EXPECT_NEAR(double(kShConstants[i]), y[i], 1e-7);
    EXPECT_NEAR(double(kShConstants[6]), y[6] / 2, 1e-7);
    EXPECT_NEAR(double(kShConstants[8]), basis({1, 0, 0})[8], 1e-7);
}

TEST(ShConventions, ConstantRadianceIsItsOwnValueInEveryPolynomial) {
    Sh3 c{};
    c[0] = glm::vec3(1, 2, 5) * float(std::sqrt(4 * kPi)); // radiance (1, 2, 5) from everywhere
    for (int ch = 0; ch < 3; ++ch) {
        const float radiance = std::array{1.f, 2.f, 5.f}[std::size_t(ch)];
        EXPECT_NEAR(irradiancePolynomial(c)[0][ch], radiance, 1e-5);
        EXPECT_NEAR(playcanvasAmbient(c)[0][ch], radiance, 1e-5);
        EXPECT_NEAR(godotDirectional(std::span<const glm::vec3, 4>(c.data(), 4))[0][ch], radiance,
                    1e-5);
    }
}

TEST(ShConventions, FilamentsBarePolynomialIsIrradianceOverPi) {
    expectsIrradiance([](const Sh3& c, const glm::dvec3& n) {
        const Sh3 e = irradiancePolynomial(c);
        const std::array<double, 9> p = {1,
                                         n.y,
                                         n.z,
                                         n.x,
                                         n.x * n.y,
                                         n.y * n.z,
                                         3 * n.z * n.z - 1,
                                         n.x * n.z,
                                         n.x * n.x - n.y * n.y};
        double sum = 0;
        for (std::size_t i = 0; i < 9; ++i)
            sum += double(e[i].x) * p[i];
        return sum;
    });
}

TEST(ShConventions, PlayCanvasPolynomialIsIrradianceOverPi) {
    expectsIrradiance([](const Sh3& c, const glm::dvec3& n) {
        const Sh3 e = playcanvasAmbient(c);
        const std::array<double, 9> p = {1,
                                         n.x,
                                         n.y,
                                         n.z,
                                         n.x * n.z,
                                         n.y * n.z,
                                         n.x * n.y,
                                         3 * n.z * n.z - 1,
                                         n.x * n.x - n.y * n.y};
        double sum = 0;
        for (std::size_t i = 0; i < 9; ++i)
            sum += double(e[i].x) * p[i];
        return sum;
    });
}

TEST(ShConventions, BabylonsHarmonicsAreIrradianceInEitherWorld) {
    // Its conversions multiply by A_l and divide by pi. A normal of glTF's world is (-x, y, z) in
    // the left-handed one; in the right-handed one the shader looks up (x, y, -z).
    for (const BabylonWorld world : {BabylonWorld::LeftHanded, BabylonWorld::RightHanded}) {
        const auto lookup = [world](const glm::dvec3& n) {
            return world == BabylonWorld::LeftHanded ? glm::dvec3(-n.x, n.y, n.z)
                                                     : glm::dvec3(n.x, n.y, -n.z);
        };
        expectsIrradiance([&](const Sh3& c, const glm::dvec3& n) {
            Sh3 h = babylonHarmonics(c, world);
            for (std::size_t i = 0; i < 9; ++i)
                h[i] *= float(kConvolved[i]);
            return babylon(h, lookup(n));
        });
        expectsIrradiance([&](const Sh3& c, const glm::dvec3& n) {
            return babylon(imageBasedLight(c, world), lookup(n)) / kPi;
        });
    }
}

TEST(ShConventions, GodotsProbesAreIrradianceOverPi) {
    // Its shader convolves by A_l with constants K_i, and does not divide by pi.
    expectsIrradiance([](const Sh3& c, const glm::dvec3& n) {
        const Sh3 p = godotProbe(c);
        double sum = 0;
        for (std::size_t i = 0; i < 9; ++i)
            sum += kPi * kConvolved[i] * basis(n)[i] * double(p[i].x);
        return sum;
    });
}

TEST(ShConventions, GodotsDirectionalTexelsAreIrradianceOverPiOfTwoBands) {
    expectsIrradiance(
        [](const Sh3& c, const glm::dvec3& n) {
            const auto t = godotDirectional(std::span<const glm::vec3, 4>(c.data(), 4));
            const double l0 = t[0].x;
            const auto slope = [&](std::size_t i) { return (t[i].x - 0.5) * 8 * l0; };
            return l0 + slope(1) * n.y + slope(2) * n.z + slope(3) * n.x;
        },
        4);
}

TEST(ShConventions, GodotsDirectionalTexelsStayInRange) {
    const std::array<glm::vec3, 4> steep = {glm::vec3(0.001f, 0, -1), glm::vec3(9), glm::vec3(-9),
                                            glm::vec3(0)};
    const auto t = godotDirectional(steep);
    EXPECT_EQ(t[1].x, 1);
    EXPECT_EQ(t[2].x, 0);
    EXPECT_EQ(t[1].y, 0.5f); // no light: no direction
    EXPECT_EQ(t[0].z, 0);
}

TEST(ShConventions, AGridCellHoldsNineColoursOneAfterTheOther) {
    Sh3 c;
    for (int i = 0; i < 9; ++i)
        c[std::size_t(i)] = glm::vec3(3 * i, 3 * i + 1, 3 * i + 2);
    const auto cell = threeGridCell(c);
    for (int n = 0; n < 27; ++n)
        EXPECT_EQ(cell[std::size_t(n / 4)][n % 4], float(n));
    EXPECT_EQ(cell[6].w, 0);
}

} // namespace limn::sh_conventions_test
