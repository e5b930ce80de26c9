// SPDX-License-Identifier: MIT
#include "engine/picture/nonnegative_fit.h"

#include <gtest/gtest.h>

#include <random>

namespace limn::nonnegative_fit_test {
namespace {

/// Half the gradient of the sum of squares, downhill.
std::vector<double> descent(const LinearSystem& s, const std::vector<double>& x) {
    std::vector<double> result(s.unknowns);
    for (std::size_t row = 0; row < s.right.size(); ++row) {
        const double* a = &s.matrix[row * s.unknowns];
        double difference = s.right[row];
        for (std::size_t k = 0; k < s.unknowns; ++k)
            difference -= a[k] * x[k];
        for (std::size_t k = 0; k < s.unknowns; ++k)
            result[k] += a[k] * difference;
    }
    return result;
}

TEST(NonnegativeFit, SolvesWhatHasASolution) {
    const std::vector<double> x = nonnegativeFit({2, {2, 1, 1, 3}, {4, 7}});
    EXPECT_NEAR(x[0], 1, 1e-12);
    EXPECT_NEAR(x[1], 2, 1e-12);
}

TEST(NonnegativeFit, LeavesAtZeroWhatWouldBeNegative) {
    // Without the bound, (-1, 3). With the first at 0, the second is the mean of 2 and 1.
    const std::vector<double> x = nonnegativeFit({2, {1, 1, 2, 1}, {2, 1}});
    EXPECT_EQ(x[0], 0);
    EXPECT_NEAR(x[1], 1.5, 1e-12);
    EXPECT_EQ(nonnegativeFit({1, {1}, {-3}})[0], 0);
}

TEST(NonnegativeFit, MeetsTheConditionsOfALeastSum) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 200; ++trial) {
        const std::size_t unknowns = 1 + random() % 12, equations = unknowns + random() % 20;
        LinearSystem s{.unknowns = unknowns};
        for (std::size_t k = 0; k < unknowns * equations; ++k)
            s.matrix.push_back(normal(random));
        for (std::size_t k = 0; k < equations; ++k)
            s.right.push_back(normal(random));
        const std::vector<double> x = nonnegativeFit(s), down = descent(s, x);
        for (std::size_t k = 0; k < unknowns; ++k) {
            EXPECT_GE(x[k], 0);
            EXPECT_LT(down[k], 1e-9) << "more of it would be better";
            if (x[k] > 0) {
                EXPECT_NEAR(down[k], 0, 1e-9);
            }
        }
    }
}

} // namespace
} // namespace limn::nonnegative_fit_test
