// SPDX-License-Identifier: MIT
#include "engine/math/packing.h"

#include "engine/core/flush_denormals.h"

#include "engine/math/sampling.h"

#include <gtest/gtest.h>

#include <limits>

namespace limn::packing_test {
namespace {

TEST(Half, EveryFiniteHalfSurvivesARoundTrip) {
    for (std::uint32_t h = 0; h < 0x10000; ++h) {
        if ((h & 0x7c00U) == 0x7c00U)
            continue;
        EXPECT_EQ(floatToHalf(halfToFloat(std::uint16_t(h))), h);
    }
}

TEST(Half, IsTheSameWhereDenormalFloatsAreFlushed) {
    for (std::uint32_t h = 0; h < 0x10000; ++h) {
        const std::uint32_t exponent = h >> 10 & 31U, mantissa = h & 0x3ffU;
        if (exponent == 31)
            continue;
        const float is = exponent == 0 ? std::ldexp(float(mantissa), -24)
                                       : std::ldexp(float(1024 + mantissa), int(exponent) - 25);
        const FlushDenormals flush;
        ASSERT_EQ(halfToFloat(std::uint16_t(h)), h < 0x8000U ? is : -is) << h;
        ASSERT_EQ(floatToHalf(is), h & 0x7fffU);
    }
}

TEST(Half, RoundsToTheNearestHalf) {
    EXPECT_EQ(halfToFloat(floatToHalf(1 + 0x1p-11f)), 1.f);             // tie: to even
    EXPECT_EQ(halfToFloat(floatToHalf(1 + 3 * 0x1p-11f)), 1 + 0x1p-9f); // tie: to even
    EXPECT_EQ(halfToFloat(floatToHalf(1 + 0x1.1p-11f)), 1 + 0x1p-10f);
    EXPECT_EQ(floatToHalf(65519.f), 0x7bffU);
    EXPECT_EQ(floatToHalf(65520.f), 0x7c00U);
    EXPECT_EQ(halfToFloat(floatToHalf(-2.5f)), -2.5f);
    EXPECT_EQ(floatToHalf(0x1p-26f), 0U);
    for (float v = 0x1p-14f; v < 60000; v *= 1.0137f)
        EXPECT_NEAR(halfToFloat(floatToHalf(v)) / v, 1, 0x1p-11 + 1e-7);
}

TEST(Rgb9e5, IsWithinHalfAStepOfTheLargestComponentAndNeverNegativeOrInfinite) {
    for (float most = 0x1p-13f; most < 65408; most *= 1.37f) {
        const glm::vec3 color(most, most * 0.3f, most * 0.01f);
        const glm::vec3 back = unpackRgb9e5(packRgb9e5(color));
        for (int c = 0; c < 3; ++c)
            EXPECT_LE(std::abs(back[c] - color[c]), most / 512) << most;
    }
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(unpackRgb9e5(packRgb9e5({65408, 1e30f, infinity})), glm::vec3(65408));
    EXPECT_EQ(unpackRgb9e5(packRgb9e5({-1, std::nanf(""), 0x1p-26f})), glm::vec3(0));
    EXPECT_EQ(unpackRgb9e5(packRgb9e5({0x1p-24f, 0, 0})), glm::vec3(0x1p-24f, 0, 0));
    // Rounding up carries into the exponent.
    EXPECT_EQ(unpackRgb9e5(packRgb9e5({1023.9f, 512, 0})), glm::vec3(1024, 512, 0));
}

TEST(Rgb9e5, EveryPackedNumberThatPackingGivesSurvives) {
    for (std::uint32_t exponent = 0; exponent < 32; ++exponent)
        for (std::uint32_t m = exponent > 0 ? 256 : 0; m < 512; ++m) {
            const std::uint32_t packed = exponent << 27 | m | (m / 2) << 9 | 1U << 18;
            EXPECT_EQ(packRgb9e5(unpackRgb9e5(packed)), packed);
        }
}

// Half a step of 1/32767 in x and y, twice that in z, over the octahedron's least length 1/sqrt(3).
constexpr float kOctError = 6.5e-5f;

TEST(Oct, DirectionsSurviveWithinTheStatedAngle) {
    const DirectionSet set(20000, true, 11);
    double worst = 0;
    for (std::uint32_t i = 0; i < set.count; ++i) {
        const Oct16 packed = packOct(set[i]);
        worst = std::max(
            worst, double(glm::length(unpackOct(packed.x, packed.y) - glm::normalize(set[i]))));
    }
    EXPECT_LT(worst, kOctError);
    for (const glm::vec3 axis :
         {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)}) {
        const Oct16 packed = packOct(axis);
        EXPECT_LT(glm::length(unpackOct(packed.x, packed.y) - axis), kOctError);
    }
}

TEST(DirectionSet, CoversTheHemisphereEvenly) {
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        const DirectionSet set(1024, false, seed);
        glm::dvec3 mean{0};
        for (std::uint32_t i = 0; i < set.count; ++i) {
            EXPECT_GE(set[i].z, 0);
            EXPECT_NEAR(glm::length(set[i]), 1, 1e-5);
            mean += glm::dvec3(set[i]) / double(set.count);
        }
        EXPECT_NEAR(mean.x, 0, 2e-3);
        EXPECT_NEAR(mean.y, 0, 2e-3);
        EXPECT_NEAR(mean.z, 0.5, 1e-6);
    }
}

TEST(DirectionSet, SumsOfSolidAnglesHaveNoError) {
    for (const bool sphere : {false, true})
        for (const float even : {1.f, 0.5f, 0.01f})
            for (const std::uint32_t count : {1U, 7U, 256U, 4096U}) {
                const DirectionSet set(count, sphere, 3, even);
                double angle = 0, cosine = 0;
                for (std::uint32_t i = 0; i < count; ++i) {
                    angle += double(set.solidAngle(i));
                    cosine += double(set.solidAngle(i)) * std::abs(double(set.height(i)));
                    EXPECT_NEAR(set[i].z, set.height(i), 1e-6f);
                    EXPECT_NEAR(set.above(set.bound(i)), float(i) / float(count), 1e-6f);
                }
                EXPECT_NEAR(angle, (sphere ? 4 : 2) * std::numbers::pi, 1e-5);
                if (!sphere || count % 2 == 0) {
                    EXPECT_NEAR(cosine, (sphere ? 2 : 1) * std::numbers::pi, 1e-5);
                }
            }
}

TEST(DirectionSet, HasTheDensityItSays) {
    const std::uint32_t count = 40000;
    for (const float even : {1.f, 0.5f, 0.1f}) {
        const DirectionSet set(count, false, 3, even);
        for (float z = 0.05f; z < 1; z += 0.1f) { // rings of a tenth, each of 2 pi / 10 sr
            std::uint32_t inRing = 0;
            for (std::uint32_t i = 0; i < count; ++i)
                inRing += std::abs(set[i].z - z) < 0.05f ? 1 : 0;
            const double expected = double(set.density(z)) * 2 * std::numbers::pi / 10;
            EXPECT_NEAR(inRing, expected, 2) << even << " " << z;
        }
    }
}

TEST(DirectionSet, FindsTheIrradianceOfALampAtEveryHeight) {
    const double half = 0.1, solidAngle = 2 * std::numbers::pi * (1 - std::cos(half));
    for (const double height : {0.15, 0.4, 0.7, 0.95}) {
        const glm::vec3 lamp(std::sqrt(1 - height * height), 0, height);
        for (const float even : {1.f, 0.5f}) {
            double mean = 0;
            constexpr std::uint32_t kSets = 400;
            for (std::uint32_t seed = 0; seed < kSets; ++seed) {
                const DirectionSet set(256, false, seed, even);
                for (std::uint32_t i = 0; i < set.count; ++i)
                    if (double(glm::dot(set[i], lamp)) > std::cos(half))
                        mean += double(set.solidAngle(i) * set[i].z) / kSets;
            }
            // The integral of the cosine over a cap: of the vectors in it, which add up to its
            // axis times its solid angle times (1 + cos) / 2, the z component.
            const double expected = solidAngle * height * (1 + std::cos(half)) / 2;
            EXPECT_NEAR(mean, expected, 0.03 * expected) << even << " " << height;
        }
    }
}

TEST(Basis, IsOrthonormalAndRightHanded) {
    const DirectionSet set(500, true, 5);
    for (std::uint32_t i = 0; i < set.count; ++i) {
        const glm::mat3 m = basisAround(set[i]);
        EXPECT_NEAR(glm::dot(m[0], m[1]), 0, 1e-5);
        EXPECT_NEAR(glm::dot(m[0], m[2]), 0, 1e-5);
        EXPECT_LT(glm::length(glm::cross(m[0], m[1]) - m[2]), 1e-5f);
    }
}

TEST(Halton, RadicalInverseMirrorsTheDigits) {
    EXPECT_FLOAT_EQ(radicalInverse(1, 2), 0.5f);
    EXPECT_FLOAT_EQ(radicalInverse(6, 2), 0.375f);            // 110 -> 0.011
    EXPECT_FLOAT_EQ(radicalInverse(5, 3), 2.f / 3 + 1.f / 9); // 12 -> 0.21
}

} // namespace
} // namespace limn::packing_test
