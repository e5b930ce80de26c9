// SPDX-License-Identifier: MIT
#include "editor_ui/panels/time_history.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace limn::time_history_test {
namespace {

LightingReport taking(double ms) {
    LightingReport r;
    for (int i = 1; i <= 5; ++i)
        r.steps.push_back({"step", "A step", "What it does", i * ms});
    return r;
}

TEST(TimeHistory, KeepsTheLatestStepByStep) {
    TimeHistory history;
    EXPECT_EQ(history.size(), 0U);
    EXPECT_EQ(history.longest(), 0);
    history.add(taking(1000)); // forgotten below
    for (std::size_t i = 1; i <= TimeHistory::kLength; ++i) {
        history.add(taking(double(i)));
        EXPECT_EQ(history.size(), std::min(i + 1, TimeHistory::kLength));
        EXPECT_EQ(history.at(0), (TimeHistory::Steps{float(i), 2 * float(i), 3 * float(i),
                                                     4 * float(i), 5 * float(i)}));
    }
    EXPECT_EQ(history.at(TimeHistory::kLength - 1)[0], 1);
    EXPECT_EQ(history.longest(), 15 * float(TimeHistory::kLength));
}

TEST(TimeHistory, UpdatesWithoutWorkLeaveNoTrace) {
    TimeHistory history;
    LightingReport skipped = taking(1);
    skipped.skipped = true;
    history.add(skipped);
    EXPECT_EQ(history.size(), 0U);
}

TEST(TimeHistory, BeginsAnewWithTheStepsOfAnotherTechnique) {
    TimeHistory history;
    history.add(taking(1));
    history.add(taking(2));
    LightingReport other;
    other.steps = {{"all", "All of it", "What it does", 7}};
    history.add(other);
    EXPECT_EQ(history.size(), 1U);
    EXPECT_EQ(history.longest(), 7);
    EXPECT_STREQ(history.labels[0], "All of it");
    EXPECT_EQ(history.labels[1], nullptr);
}

TEST(TimeHistory, StepsBeyondItsColoursAreAddedToTheLast) {
    TimeHistory history;
    LightingReport r = taking(1);
    for (int i = 0; i < 5; ++i)
        r.steps.push_back({"more", "One more", "What it does", 1});
    history.add(r);
    EXPECT_EQ(history.at(0).back(), 4);
    EXPECT_EQ(history.longest(), 20);
}

} // namespace
} // namespace limn::time_history_test
