// SPDX-License-Identifier: MIT
#include "engine/math/ycocg.h"

#include <gtest/gtest.h>

#include <random>

namespace limn::ycocg_test {
namespace {

TEST(YCoCg, TurnsBackIntoTheSameColour) {
    std::mt19937 rng(1);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 c(unit(rng), unit(rng), unit(rng)), back = toRgb(toYCoCg(c));
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(back[k], c[k], 3e-7f);
    }
}

TEST(YCoCg, GreyHasNoChrominanceAtAll) {
    std::mt19937 rng(2);
    std::exponential_distribution<float> strength;
    for (int i = 0; i < 1000; ++i) {
        const float x = strength(rng);
        const YCoCg c = toYCoCg(glm::vec3(x));
        EXPECT_EQ(c.y, x);
        EXPECT_EQ(c.co, 0);
        EXPECT_EQ(c.cg, 0);
    }
}

TEST(YCoCg, HalfOfLumaIsGreen) {
    EXPECT_EQ(toYCoCg({4, 0, 0}).y, 1);
    EXPECT_EQ(toYCoCg({0, 4, 0}).y, 2);
    EXPECT_EQ(toYCoCg({0, 0, 4}).y, 1);
    EXPECT_EQ(toYCoCg({4, 0, 0}).co, 2);
    EXPECT_EQ(toYCoCg({0, 4, 0}).cg, 2);
}

} // namespace
} // namespace limn::ycocg_test
