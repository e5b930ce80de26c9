// SPDX-License-Identifier: MIT
#include "engine/measure/successive_halving.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

namespace limn::successive_halving_test {
namespace {

/// A lattice of three counts, each a power of 2, with costs and errors in closed form: the time is
/// that of a and of b c, the memory that of b c, and the error falls with each count.
struct Lattice {
    static constexpr std::size_t kSide = 12;
    std::set<std::pair<std::size_t, int>> measured;
    double noise = 0; ///< of errors at level 0, relative

    static double count(std::size_t candidate, int axis) {
        for (int k = 0; k < axis; ++k)
            candidate /= kSide;
        return std::exp2(double(candidate % kSide) / 2);
    }
    static TrialFigures figures(std::size_t c) {
        const double a = count(c, 0), b = count(c, 1), d = count(c, 2);
        return {1 / a + 0.5 / b + 2 / d, 0.2 * a + 0.05 * b * d, 3 * b * d};
    }
    static std::vector<std::size_t> all() {
        std::vector<std::size_t> all(kSide * kSide * kSide);
        for (std::size_t c = 0; c < all.size(); ++c)
            all[c] = c;
        return all;
    }
    static std::vector<std::size_t> neighbours(std::size_t c) {
        std::vector<std::size_t> result;
        for (std::size_t step : {std::size_t(1), kSide, kSide * kSide}) {
            const std::size_t place = c / step % kSide;
            if (place > 0)
                result.push_back(c - step);
            if (place + 1 < kSide)
                result.push_back(c + step);
        }
        return result;
    }
    static std::size_t optimum(const SearchGoal& goal) {
        std::size_t best = 0;
        for (const std::size_t c : all())
            if (isBetter(goal, figures(c), figures(best)))
                best = c;
        return best;
    }

    SearchSteps steps() {
        return {.measure = [this](std::size_t c, int level) -> Result<std::optional<TrialFigures>> {
                    EXPECT_TRUE(measured.insert({c, level}).second)
                        << c << " is measured twice at level " << level;
                    TrialFigures f = figures(c);
                    f.error *= 1 + (level == 0 ? noise * std::sin(double(c)) : 0);
                    return std::optional(f);
                },
                .neighbours = neighbours};
    }
};

const SearchGoal kGoals[] = {{.maxMs = 5},
                             {.maxBytes = 200},
                             {.maxMs = 3, .maxBytes = 100},
                             {.maxError = 0.5},
                             {.maxBytes = 300, .maxError = 0.3}};

TEST(SuccessiveHalving, FindsTheOptimumOfAll) {
    for (const SearchGoal& goal : kGoals) {
        Lattice lattice;
        const Result<SearchResult> found = successiveHalving(Lattice::all(), goal, lattice.steps());
        ASSERT_TRUE(found && found->best);
        const TrialFigures best = found->best->figures,
                           optimum = Lattice::figures(Lattice::optimum(goal));
        EXPECT_LE(excess(goal, best), 1);
        EXPECT_EQ(found->best->level, 2);
        EXPECT_FALSE(isBetter(goal, optimum, best));
        EXPECT_EQ(found->trials.size(), lattice.measured.size());
    }
}

TEST(SuccessiveHalving, ComesNearTheOptimumFromAFew) {
    for (const SearchGoal& goal : kGoals) {
        Lattice lattice;
        lattice.noise = 0.02;
        std::vector<std::size_t> few;
        for (std::size_t c = 17; c < Lattice::all().size(); c += 101)
            few.push_back(c);
        const Result<SearchResult> found = successiveHalving(few, goal, lattice.steps());
        ASSERT_TRUE(found && found->best);
        EXPECT_LE(excess(goal, found->best->figures), 1) << "limits are kept";
        const TrialFigures best = found->best->figures,
                           optimum = Lattice::figures(Lattice::optimum(goal));
        if (goal.maxError)
            EXPECT_LE(best.ms, 1.3 * optimum.ms);
        else
            EXPECT_LE(best.error, 1.2 * optimum.error);
        EXPECT_LT(lattice.measured.size(), Lattice::all().size() / 6);
    }
}

TEST(SuccessiveHalving, MeasuresTheBetterHalfAgain) {
    Lattice lattice;
    SearchSteps steps = lattice.steps();
    steps.neighbours = nullptr;
    const SearchGoal goal{.maxMs = 4};
    const std::vector<std::size_t> five = {3, 200, 700, 900, 1500};
    ASSERT_TRUE(successiveHalving(five, goal, steps));
    int counts[3] = {};
    for (const auto& [candidate, level] : lattice.measured)
        ++counts[level];
    EXPECT_EQ(counts[0], 5);
    EXPECT_EQ(counts[1], 3);
    EXPECT_EQ(counts[2], 2);
}

TEST(SuccessiveHalving, SaysWhereNothingKeepsTheLimits) {
    Lattice lattice;
    const SearchGoal goal{.maxMs = 0.1};
    const Result<SearchResult> found = successiveHalving({1727, 500}, goal, lattice.steps());
    ASSERT_TRUE(found && found->best);
    EXPECT_EQ(found->best->candidate, 0U) << "the cheapest is nearest to the limit";
    EXPECT_NEAR(excess(goal, found->best->figures), 2.5, 1e-9);
}

TEST(SuccessiveHalving, EndsWhereTimeDoesAndFailsWhereMeasuringDoes) {
    Lattice lattice;
    SearchSteps steps = lattice.steps();
    int left = 7;
    const auto measure = steps.measure;
    steps.measure = [&](std::size_t c, int level) -> Result<std::optional<TrialFigures>> {
        return left-- > 0 ? measure(c, level) : std::optional<TrialFigures>();
    };
    const SearchGoal goal{.maxMs = 5};
    const Result<SearchResult> stopped = successiveHalving({3, 200, 700, 900}, goal, steps);
    ASSERT_TRUE(stopped && stopped->best);
    EXPECT_EQ(stopped->trials.size(), 7U);
    left = 0;
    const Result<SearchResult> none = successiveHalving({3, 200}, goal, steps);
    ASSERT_TRUE(none);
    EXPECT_FALSE(none->best);
    steps.measure = [](std::size_t, int) -> Result<std::optional<TrialFigures>> {
        return fail("cancelled");
    };
    const Result<SearchResult> failed = successiveHalving({3, 200}, goal, steps);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().message, "cancelled");
}

TEST(SuccessiveHalving, ALowerLevelCountsWhereNothingKeepsTheLimitsAtTheLast) {
    Lattice lattice;
    SearchSteps steps = lattice.steps();
    steps.neighbours = nullptr;
    const auto measure = steps.measure;
    steps.measure = [&](std::size_t c, int level) -> Result<std::optional<TrialFigures>> {
        auto figures = measure(c, level);
        if (figures && *figures && level == 2)
            (*figures)->ms += 1000; // something else takes the machine's time
        return figures;
    };
    const SearchGoal goal{.maxMs = 500};
    const Result<SearchResult> found = successiveHalving({3, 200, 700, 900}, goal, steps);
    ASSERT_TRUE(found && found->best);
    EXPECT_EQ(found->best->level, 1);
    for (const Trial& trial : found->trials)
        EXPECT_FALSE(trial.level == 1 && isBetter(goal, trial.figures, found->best->figures));
}

TEST(SearchGoal, WhatIsNoNumberIsWorst) {
    const TrialFigures good{1, 1, 1}, bad{std::nan(""), 1, 1};
    EXPECT_TRUE(isBetter({}, good, bad));
    EXPECT_FALSE(isBetter({}, bad, good));
    EXPECT_TRUE(std::isinf(excess({}, bad)));
}

} // namespace
} // namespace limn::successive_halving_test
