// SPDX-License-Identifier: MIT
#include "engine/shading/sampler.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include <glm/geometric.hpp>

namespace limn::sampler_test {

// 2^m points of a (0, 2)-sequence put exactly one into every box of area 2^-m with sides 2^-a,
// 2^-b.
TEST(Sampler, EveryPairOfDimensionsIsStratifiedInAllBoxes) {
    constexpr std::uint32_t m = 8;
    for (std::uint32_t seed = 0; seed < 5; ++seed)
        for (std::uint32_t dimension : {0u, 1u, 7u, 100u})
            for (std::uint32_t a = 0; a <= m; ++a) {
                std::set<std::pair<int, int>> boxes;
                for (std::uint32_t i = 0; i < 1u << m; ++i) {
                    const glm::vec2 p = Sampler{seed, i}.pair(dimension);
                    ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
                    boxes.emplace(int(p.x * float(1 << a)), int(p.y * float(1 << (m - a))));
                }
                EXPECT_EQ(boxes.size(), std::size_t(1) << m) << "split " << a;
            }
}

TEST(Sampler, PairsSeedsAndDimensionsAreIndependent) {
    // The covariance of two independent uniforms over n points is 0 +- 1 / (12 sqrt(n)).
    constexpr std::uint32_t n = 4096;
    for (std::uint32_t other = 1; other < 40; ++other) {
        double dimensions = 0, seeds = 0;
        for (std::uint32_t i = 0; i < n; ++i) {
            const double x = double(Sampler{7, i}.pair(3).x) - 0.5;
            dimensions += x * (double(Sampler{7, i}.pair(3 + other).x) - 0.5);
            seeds += x * (double(Sampler{7 + other, i}.pair(3).x) - 0.5);
        }
        EXPECT_LT(std::abs(dimensions) / n, 5 / (12 * std::sqrt(double(n))));
        EXPECT_LT(std::abs(seeds) / n, 5 / (12 * std::sqrt(double(n))));
    }
}

TEST(Sampler, CosineHemisphereHasTheMomentsOfCosOverPi) {
    constexpr std::uint32_t n = 1 << 14;
    for (glm::vec3 normal : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(1, 0, 0),
                             glm::normalize(glm::vec3(-1, 2, -3))}) {
        glm::dvec3 mean(0);
        double cosSquared = 0;
        for (std::uint32_t i = 0; i < n; ++i) {
            const glm::vec3 d = sampleCosineHemisphere(normal, Sampler{1, i}.pair(0));
            ASSERT_NEAR(glm::length(d), 1, 1e-5f);
            ASSERT_GE(glm::dot(d, normal), -1e-6f);
            mean += glm::dvec3(d) / double(n);
            cosSquared += double(glm::dot(d, normal)) * double(glm::dot(d, normal)) / n;
        }
        // E[d] = 2/3 n, E[cos^2] = 1/2; low-discrepancy points err by far less than 1 / n^(1/2).
        EXPECT_LT(glm::length(mean - 2.0 / 3.0 * glm::dvec3(normal)), 1e-3);
        EXPECT_NEAR(cosSquared, 0.5, 1e-3);
    }
}

} // namespace limn::sampler_test
