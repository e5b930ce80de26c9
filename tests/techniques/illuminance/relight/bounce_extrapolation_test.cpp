// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/bounce_extrapolation.h"

#include "engine/core/parallel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace limn::bounce_extrapolation_test {
namespace {

/// A linear bounce with a known fixed point. Each surfel passes on a part of its own light and a
/// part of the mean, so that the map is symmetric.
struct Bounces {
    std::vector<glm::vec3> albedo, irradiance;
    std::vector<glm::vec4> radiosity;
    std::vector<float> area, share;
    std::vector<glm::vec3> source;
    float own = 0.3f, mean = 0.6f;

    explicit Bounces(std::size_t count)
        : albedo(count, glm::vec3(1)), irradiance(count, glm::vec3(0)),
          radiosity(count, glm::vec4(1)), area(count, 1.f), share(count, 1 / float(count)) {
        for (std::size_t i = 0; i < count; ++i)
            source.push_back(
                {1 + std::sin(float(i)), 2 + std::cos(float(3 * i)), float(i % 7) / 7});
    }
    BouncingSurfels surfels() const { return {albedo, radiosity, area, share}; }
    void bounce() {
        glm::dvec3 sum(0);
        for (const glm::vec3& e : irradiance)
            sum += glm::dvec3(e);
        const glm::vec3 all = glm::vec3(sum / double(irradiance.size()));
        for (std::size_t i = 0; i < irradiance.size(); ++i)
            irradiance[i] = own * irradiance[i] + mean * all + source[i];
    }
    /// Relative to the mean, the mean distance from the fixed point: with the mean m = (mean of the
    /// source) / (1 - own - mean), e = (source + mean m) / (1 - own).
    double error() const {
        glm::dvec3 sum(0);
        for (const glm::vec3& s : source)
            sum += glm::dvec3(s);
        const glm::dvec3 m = sum / double(source.size()) / double(1 - own - mean);
        double wrong = 0;
        for (std::size_t i = 0; i < source.size(); ++i)
            wrong += glm::length(glm::dvec3(irradiance[i]) -
                                 (glm::dvec3(source[i]) + double(mean) * m) / double(1 - own));
        return wrong / double(source.size()) / glm::length(m);
    }
};

// A combination of three bounces solves a map of two eigenvalues.
TEST(BounceExtrapolation, FindsTheFixedPointOfTwoRatiosInFourBounces) {
    Bounces b(5000), plain(5000);
    BounceExtrapolation ahead;
    for (int k = 0; k < 4; ++k) {
        ahead.begin(b.irradiance);
        b.bounce();
        ahead.end(b.surfels(), b.irradiance);
        plain.bounce();
    }
    EXPECT_LT(b.error(), 1e-5);
    EXPECT_GT(plain.error(), 0.5);
    ASSERT_TRUE(ahead.residual());
    EXPECT_NEAR(ahead.residual()->passedOn, 0.9, 1e-2) << "the larger ratio";
}

TEST(BounceExtrapolation, LeavesLightThatGrowsAloneOnceThatShows) {
    Bounces b(100);
    b.mean = 0.75f;
    BounceExtrapolation ahead;
    const auto bounce = [&] {
        ahead.begin(b.irradiance);
        b.bounce();
        Bounces plain = b;
        ahead.end(b.surfels(), b.irradiance);
        return plain.irradiance == b.irradiance;
    };
    for (int k = 0; k < 6; ++k)
        bounce();
    EXPECT_TRUE(bounce());
    EXPECT_FALSE(ahead.residual());
    b.mean = 0.6f;
    ahead.clear();
    for (int k = 0; k < 6; ++k)
        bounce();
    EXPECT_TRUE(ahead.residual());
    EXPECT_LT(b.error(), 1e-4);
}

// The squares of such light lie beyond the range of floats.
TEST(BounceExtrapolation, OfLightOfAnyStrengthIsTheSame) {
    const auto ahead = [](float strength) {
        Bounces b(1000);
        for (glm::vec3& s : b.source)
            s *= strength;
        BounceExtrapolation extrapolation;
        for (int k = 0; k < 6; ++k) {
            extrapolation.begin(b.irradiance);
            b.bounce();
            extrapolation.end(b.surfels(), b.irradiance);
        }
        for (glm::vec3& e : b.irradiance)
            e /= strength;
        return b.irradiance;
    };
    const std::vector<glm::vec3> one = ahead(1);
    for (const float strength : {0x1p90f, 0x1p-90f})
        EXPECT_EQ(ahead(strength), one) << strength;
}

TEST(BounceExtrapolation, IsTheSameForAnyNumberOfThreads) {
    std::vector<std::vector<glm::vec3>> light;
    for (const int threads : {1, 2, 3}) {
        const ThreadLimit limit(threads);
        Bounces b(20000);
        BounceExtrapolation ahead;
        for (int k = 0; k < 3; ++k) {
            ahead.begin(b.irradiance);
            b.bounce();
            ahead.end(b.surfels(), b.irradiance);
        }
        light.push_back(b.irradiance);
    }
    EXPECT_EQ(light[0], light[1]);
    EXPECT_EQ(light[0], light[2]);
}

TEST(BounceExtrapolation, DoesNothingWithoutABeginningAndKeepsBlackBlack) {
    Bounces b(10);
    b.source.assign(10, glm::vec3(0));
    BounceExtrapolation ahead;
    const std::vector<glm::vec3> before = b.irradiance;
    ahead.end(b.surfels(), b.irradiance);
    EXPECT_EQ(b.irradiance, before);
    for (int k = 0; k < 5; ++k) {
        ahead.begin(b.irradiance);
        b.bounce();
        ahead.end(b.surfels(), b.irradiance);
        EXPECT_EQ(b.irradiance, before);
    }
    EXPECT_GT(ahead.bytes(), 0u);
    ahead.release();
    EXPECT_EQ(ahead.bytes(), 0u);
}

} // namespace
} // namespace limn::bounce_extrapolation_test
