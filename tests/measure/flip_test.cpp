// SPDX-License-Identifier: MIT
#include "engine/measure/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace limn::flip_test {
namespace {

ImageF constantImage(std::uint32_t width, std::uint32_t height, glm::vec3 color) {
    return {width, height, std::vector<glm::vec3>(std::size_t(width) * height, color)};
}

float centre(const Plane& p) {
    return p.values[std::size_t(p.height / 2) * p.width + p.width / 2];
}

} // namespace

TEST(Flip, IsZeroForEqualSymmetricAndWithinZeroAndOne) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> value(0, 1);
    ImageF a = constantImage(50, 31, {}), b = a;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        a.rgb[i] = {value(random), value(random), value(random)};
        b.rgb[i] = {value(random), value(random), value(random)};
    }
    const Plane ab = flipMap(a, b), ba = flipMap(b, a), aa = flipMap(a, a);
    for (std::size_t i = 0; i < ab.values.size(); ++i) {
        EXPECT_EQ(ab.values[i], ba.values[i]);
        EXPECT_GE(ab.values[i], 0);
        EXPECT_LE(ab.values[i], 1);
        EXPECT_EQ(aa.values[i], 0);
    }
}

// Without features the error is the redistributed colour distance alone, which can be done by hand.
TEST(Flip, PlainColoursGiveThePublishedDistance) {
    const auto flat = [](glm::vec3 a, glm::vec3 b) {
        return double(centre(flipMap(constantImage(40, 40, a), constantImage(40, 40, b))));
    };
    // Green against blue is the largest distance by definition.
    EXPECT_NEAR(flat({0, 1, 0}, {0, 0, 1}), 1, 1e-4);
    // Lab of primaries (D65): green L 87.737, a -86.185, b 83.179; blue 32.297, 79.188, -107.860.
    // Hunt: a, b times L / 100.
    const double gL = 87.737, ga = -86.185 * 0.87737, gb = 83.179 * 0.87737;
    const double bL = 32.297, ba = 79.188 * 0.32297, bb = -107.860 * 0.32297;
    const double largest = std::pow(std::abs(gL - bL) + std::hypot(ga - ba, gb - bb), 0.7);
    // Black against white: HyAB 100.
    const double white = std::pow(100, 0.7), knee = 0.4 * largest;
    const double expected =
        white < knee ? 0.95 / knee * white : 0.95 + (white - knee) / (largest - knee) * 0.05;
    EXPECT_NEAR(flat({0, 0, 0}, {1, 1, 1}), expected, 1e-4);
    // A grey of linear 0.5 against black: L = 116 cbrt(0.5) - 16 = 76.069.
    EXPECT_NEAR(
        flat({0, 0, 0}, {0.5f, 0.5f, 0.5f}),
        [&] {
            const double power = std::pow(76.069, 0.7);
            return power < knee ? 0.95 / knee * power
                                : 0.95 + (power - knee) / (largest - knee) * 0.05;
        }(),
        1e-4);
}

TEST(Flip, EdgesAreSeenMoreThanPlainAreas) {
    const ImageF grey = constantImage(64, 64, glm::vec3(0.2f));
    ImageF flat = constantImage(64, 64, glm::vec3(0.25f)), edge = grey;
    for (std::size_t i = 0; i < edge.rgb.size(); ++i)
        if (i % 64 >= 32)
            edge.rgb[i] = glm::vec3(0.25f);
    const Plane f = flipMap(flat, grey), e = flipMap(edge, grey);
    EXPECT_GT(e.values[32 * 64 + 33], 1.2f * f.values[32 * 64 + 33]);
    EXPECT_NEAR(e.values[32 * 64 + 60], f.values[32 * 64 + 60], 1e-3f); // far from the edge
    EXPECT_NEAR(e.values[32 * 64 + 3], 0, 1e-3f);
}

TEST(Flip, FarAwayViewersSeeLessOfFinePatterns) {
    ImageF checker = constantImage(64, 64, glm::vec3(0.5f));
    for (std::size_t i = 0; i < checker.rgb.size(); ++i)
        checker.rgb[i] = glm::vec3((i + i / 64) % 2 == 0 ? 0.4f : 0.6f);
    const ImageF grey = constantImage(64, 64, glm::vec3(0.5f));
    EXPECT_GT(centre(flipMap(checker, grey, 20)), 2 * centre(flipMap(checker, grey, 200)));
}

} // namespace limn::flip_test
