// SPDX-License-Identifier: MIT
#include "engine/measure/pareto_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace limn::pareto_line_test {
namespace {

using Line = std::vector<std::size_t>;

TEST(ParetoLine, HoldsWhatNothingElseBeats) {
    const std::vector<CostAndError> choices = {
        {4, 1},   // costs most, least error
        {1, 5},   // costs least
        {2, 5},   // as wrong as the one before for more
        {3, 2},   // between
        {3, 4},   // dearer than nothing, but worse than its equal in cost
        {1, 5},   // a second one like the first
        {5, 1.5}, // worse than the first in both
    };
    EXPECT_EQ(paretoLine(choices), (Line{1, 3, 0}));
}

TEST(ParetoLine, LeavesOutWhatIsNoNumber) {
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    const std::vector<CostAndError> choices = {{nan, 0}, {0, nan},       {infinity, 0},
                                               {2, 1},   {-infinity, 0}, {1, infinity}};
    EXPECT_EQ(paretoLine(choices), Line{3});
    EXPECT_TRUE(paretoLine({}).empty());
}

TEST(ParetoLine, IsTheSetThatItsDefinitionNames) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> number(0, 20);
    for (int round = 0; round < 50; ++round) {
        std::vector<CostAndError> choices(30);
        for (CostAndError& choice : choices)
            choice = {double(number(random)), double(number(random))};
        const Line line = paretoLine(choices);
        for (std::size_t i = 0; i < choices.size(); ++i) {
            bool beaten = false;
            for (std::size_t k = 0; k < choices.size(); ++k) {
                const bool equal =
                    choices[k].cost == choices[i].cost && choices[k].error == choices[i].error;
                beaten |= k != i && choices[k].cost <= choices[i].cost &&
                          choices[k].error <= choices[i].error && (!equal || k < i);
            }
            EXPECT_EQ(std::ranges::count(line, i), beaten ? 0 : 1) << i;
        }
        for (std::size_t k = 1; k < line.size(); ++k) {
            EXPECT_LT(choices[line[k - 1]].cost, choices[line[k]].cost);
            EXPECT_GT(choices[line[k - 1]].error, choices[line[k]].error);
        }
    }
}

} // namespace
} // namespace limn::pareto_line_test
