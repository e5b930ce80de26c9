// SPDX-License-Identifier: MIT
#include "editor_ui/panels/time_history.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace limn {
namespace {

RelightStats taking(double ms) {
    RelightStats r;
    r.directMs = ms;
    r.surfelLightMs = 2 * ms;
    r.surfelReadMs = 3 * ms;
    r.pullMs = 4 * ms;
    r.cacheLightMs = 5 * ms;
    r.fieldMs = 6 * ms;
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
        EXPECT_EQ(history.at(0), (std::array<float, 5>{float(i), 5 * float(i), 4 * float(i),
                                                       5 * float(i), 6 * float(i)}));
    }
    EXPECT_EQ(history.at(TimeHistory::kLength - 1)[0], 1);
    EXPECT_EQ(history.longest(), 21 * float(TimeHistory::kLength));
}

TEST(TimeHistory, UpdatesWithoutWorkLeaveNoTrace) {
    TimeHistory history;
    RelightStats skipped = taking(1);
    skipped.skipped = true;
    history.add(skipped);
    EXPECT_EQ(history.size(), 0U);
}

} // namespace
} // namespace limn
