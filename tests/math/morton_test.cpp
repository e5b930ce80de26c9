// SPDX-License-Identifier: MIT
#include "engine/math/morton.h"

#include <gtest/gtest.h>

#include <limits>

namespace limn::morton_test {
namespace {

TEST(Morton, TakesTheAxesBitsInTurn) {
    const float step = 1 / 1024.f;
    EXPECT_EQ(mortonCode({0, 0, 0}), 0U);
    EXPECT_EQ(mortonCode({0, 0, step}), 1U);
    EXPECT_EQ(mortonCode({0, step, 0}), 2U);
    EXPECT_EQ(mortonCode({step, 0, 0}), 4U);
    EXPECT_EQ(mortonCode({0, 0, 2 * step}), 8U);
    EXPECT_EQ(mortonCode({0.5f, 0, 0}), 1U << 29);
    EXPECT_EQ(mortonCode({5 * step, 3 * step, 6 * step}), 0b101'011'110U);
}

TEST(Morton, ClampsWhatIsOutside) {
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(mortonCode({-1, -infinity, 0}), 0U);
    EXPECT_EQ(mortonCode({1, 7, infinity}), (1U << 30) - 1);
}

} // namespace
} // namespace limn::morton_test
