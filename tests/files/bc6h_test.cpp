// SPDX-License-Identifier: MIT
#include "engine/files/bc6h.h"

#include "engine/files/bc6h_modes.h"
#include "engine/math/packing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn::bc6h_test {
namespace {

Bc6hTexels roundTrip(const Bc6hTexels& texels, Bc6hSign sign = Bc6hSign::Unsigned) {
    return decodeBc6h(encodeBc6h(texels, sign), sign);
}

/// Root mean square error over the root mean square.
double errorOf(const Bc6hTexels& texels, const Bc6hTexels& decoded) {
    double squares = 0, all = 0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const glm::dvec3 d = glm::dvec3(texels[i]) - glm::dvec3(decoded[i]);
        squares += glm::dot(d, d);
        all += glm::dot(glm::dvec3(texels[i]), glm::dvec3(texels[i]));
    }
    return std::sqrt(squares / all);
}

// A line has a mode whose ends have 16 bits, enough for every half float.
TEST(Bc6h, KeepsEveryHalfFloatOfAnEvenBlock) {
    for (std::uint32_t h = 0; h <= 0x7bff; h += 7) {
        const float v = halfToFloat(std::uint16_t(h));
        Bc6hTexels block;
        block.fill({v, v / 2, 3});
        for (const Bc6hSign sign : {Bc6hSign::Unsigned, Bc6hSign::Signed}) {
            const float k = sign == Bc6hSign::Signed && h % 2 ? -1 : 1;
            const glm::vec3 expected(k * halfToFloat(std::uint16_t(h)),
                                     k * halfToFloat(floatToHalf(v / 2)), k * 3);
            Bc6hTexels signedBlock = block;
            for (glm::vec3& texel : signedBlock)
                texel *= k;
            const Bc6hTexels decoded = roundTrip(signedBlock, sign);
            for (const glm::vec3 texel : decoded)
                ASSERT_EQ(texel, expected) << h;
        }
    }
}

TEST(Bc6h, ClampsWhatHalfFloatsCannotHold) {
    constexpr float kInf = std::numeric_limits<float>::infinity();
    Bc6hTexels block;
    block.fill({std::nanf(""), -1, kInf});
    EXPECT_EQ(roundTrip(block)[5], glm::vec3(0, 0, 65504));
    EXPECT_EQ(roundTrip(block, Bc6hSign::Signed)[5], glm::vec3(0, -1, 65504));
    block.fill({-kInf, 1e9f, -1e-30f});
    EXPECT_EQ(roundTrip(block, Bc6hSign::Signed)[0], glm::vec3(-65504, 65504, 0));
}

/// Light that varies evenly over the block, and a shadow's edge through it.
Bc6hTexels lightOf(std::mt19937& random, bool edge) {
    std::uniform_real_distribution<float> uniform(0, 1);
    const auto colour = [&] {
        return glm::vec3(uniform(random), uniform(random), uniform(random)) + 0.1f;
    };
    const glm::vec3 even = 20.f * colour(), lit = 100.f * colour();
    const glm::vec2 slope(uniform(random) - 0.5f, uniform(random) - 0.5f);
    const float turn = 6.2832f * uniform(random), place = 2 * uniform(random) - 1;
    Bc6hTexels block;
    for (int i = 0; i < 16; ++i) {
        const glm::vec2 p(float(i % 4) - 1.5f, float(i / 4) - 1.5f);
        block[std::size_t(i)] = even * (1 + 0.2f * glm::dot(slope, p));
        if (edge && glm::dot(p, glm::vec2(std::cos(turn), std::sin(turn))) > place)
            block[std::size_t(i)] += lit * (1 + 0.1f * glm::dot(slope, p));
    }
    return block;
}

// Slopes change light by .6 of itself at most; 16 steps of that are .6 / 30 / sqrt(3) = .012 off on
// average, and ends of 10 to 12 bits add as much. Across edges light is up to 11 times as bright,
// 3.5 octaves, of which 16 steps are .5 ln(2) 3.5 / 15 / sqrt(3) = .047 off.
TEST(Bc6h, LosesHardlyMoreThanTheStepsOfItsLines) {
    std::mt19937 random(3);
    for (const bool edge : {false, true}) {
        double worst = 0, mean = 0;
        constexpr int kBlocks = 400;
        for (int k = 0; k < kBlocks; ++k) {
            const Bc6hTexels block = lightOf(random, edge);
            const double error = errorOf(block, roundTrip(block));
            worst = std::max(worst, error);
            mean += error / kBlocks;
        }
        std::printf("%s: mean error %.4f, worst %.4f\n", edge ? "edges" : "slopes", mean, worst);
        EXPECT_LT(mean, edge ? 0.047 : 0.012);
        EXPECT_LT(worst, edge ? 2 * 0.047 : 2 * 0.012);
    }
}

// Without a second region, the colours of two slopes would have to share a line.
TEST(Bc6h, KeepsTwoColoursApart) {
    for (std::uint32_t p = 0; p < kBc6hPartitions.size(); ++p) {
        Bc6hTexels block;
        for (std::uint32_t i = 0; i < 16; ++i) {
            const float t = 1 + 0.05f * float(i % 5);
            block[i] =
                kBc6hPartitions[p] >> i & 1U ? glm::vec3(9, 1, 2) * t : glm::vec3(1, 4, 8) / t;
        }
        EXPECT_LT(errorOf(block, roundTrip(block)), 0.03) << p;
    }
}

TEST(Bc6h, DecodesAnyBlockToFiniteLight) {
    std::mt19937 random(5);
    for (const Bc6hSign sign : {Bc6hSign::Unsigned, Bc6hSign::Signed})
        for (int k = 0; k < 2000; ++k) {
            Bc6hBlock block;
            for (std::uint8_t& byte : block)
                byte = std::uint8_t(random());
            for (const glm::vec3 t : decodeBc6h(block, sign))
                for (int c = 0; c < 3; ++c) {
                    ASSERT_LE(std::abs(t[c]), 65504);
                    ASSERT_GE(t[c], sign == Bc6hSign::Signed ? -65504 : 0);
                }
        }
}

TEST(Bc6h, IsBlackInReservedModes) {
    for (const std::uint32_t code : {19U, 23U, 27U, 31U}) {
        Bc6hBlock block;
        block.fill(0xff);
        block[0] = std::uint8_t(0xe0 | code);
        EXPECT_EQ(decodeBc6h(block, Bc6hSign::Unsigned), Bc6hTexels{});
    }
}

} // namespace
} // namespace limn::bc6h_test
