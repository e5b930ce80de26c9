// SPDX-License-Identifier: MIT
#include "engine/lighting/convergence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace limn::convergence_test {
namespace {

/// Round `k` of light of which each bounce passes on a share `q`.
RoundChange geometric(int k, double q) {
    const double change = std::pow(q, k);
    return {change, (1 - change * q) / (1 - q), change};
}

TEST(Convergence, ExpectsAsManyRoundsAsAreNeededWhereEachPassesOnAsMuch) {
    for (const double q : {0.2, 0.5, 0.8, 0.97}) {
        Convergence convergence;
        convergence.applySettings({.maxBounces = 1000, .tolerance = 0.01f});
        convergence.lightChanged();
        EXPECT_EQ(convergence.expectedRounds(), Convergence::kBringing) << "less is never enough";
        std::uint32_t expected = 0, needed = 0;
        for (int k = 0; !convergence.reached(); ++k) {
            convergence.addRound(geometric(k, q));
            needed += k > 4;
            if (k == 4)
                expected = convergence.expectedRounds();
        }
        EXPECT_NEAR(expected, needed, 1) << q;
    }
}

TEST(Convergence, ExpectsOneRoundWhereNothingIsKnown) {
    Convergence growing;
    growing.applySettings({.maxBounces = 1000, .tolerance = 0.01f});
    for (int k = 0; k < 6; ++k)
        growing.addRound({std::pow(1.1, k), 10, 1});
    EXPECT_EQ(growing.expectedRounds(), 1U);
    Convergence dark;
    for (int k = 0; k < 6; ++k)
        dark.addRound({});
    EXPECT_EQ(dark.expectedRounds(), 1U);
}

} // namespace
} // namespace limn::convergence_test
