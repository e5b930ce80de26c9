// SPDX-License-Identifier: MIT
#include "engine/math/packing.h"

#include "engine/math/sampling.h"

#include <gtest/gtest.h>

namespace limn {
namespace {

TEST(Half, EveryFiniteHalfSurvivesARoundTrip) {
    for (std::uint32_t h = 0; h < 0x10000; ++h) {
        if ((h & 0x7c00U) == 0x7c00U)
            continue;
        EXPECT_EQ(floatToHalf(halfToFloat(std::uint16_t(h))), h);
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
} // namespace limn
