// SPDX-License-Identifier: MIT
#include "engine/math/unit_vector.h"

#include <gtest/gtest.h>

#include <limits>

namespace limn::unit_vector_test {
namespace {

TEST(UnitVector, IsTheSameForEveryLength) {
    const glm::vec3 fallback(0, 1, 0);
    for (const glm::vec3 v : {glm::vec3(1, 2, 3), glm::vec3(-0.3f, 0, 0.7f), glm::vec3(0, 0, -1)}) {
        const glm::vec3 unit = unitOr(v, fallback);
        EXPECT_NEAR(glm::length(unit), 1, 1e-6);
        EXPECT_GT(glm::dot(unit, v), 0);
        for (const int exponent : {-120, -100, -60, -50, -40, 40, 50, 60, 100, 120})
            EXPECT_EQ(unitOr(v * std::exp2(float(exponent)), fallback), unit) << exponent;
    }
}

TEST(UnitVector, OfWhatHasNoDirectionIsTheFallback) {
    const glm::vec3 fallback(0, 1, 0);
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();
    for (const glm::vec3 v : {glm::vec3(0), glm::vec3(infinity, 1, 1), glm::vec3(nan)})
        EXPECT_EQ(unitOr(v, fallback), fallback);
}

} // namespace
} // namespace limn::unit_vector_test
