// SPDX-License-Identifier: MIT
#include "engine/measure/settings_sweep.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace limn::settings_sweep_test {
namespace {

const SettingsSweep kSweep = {
    {"surfels", {"100", "200", "400"}}, {"links", {"8", "16"}}, {"storage", {"rtp", "sh"}}};

TEST(SettingsSweep, HasEveryCombinationOnTopOfTheStart) {
    BakeSettings start;
    start.rays = 77;
    const std::vector<BakeSettings> rows = sweepRows(kSweep, start);
    ASSERT_EQ(rows.size(), 12U);
    for (const BakeSettings& row : rows) {
        EXPECT_EQ(row.rays, 77U);
        EXPECT_EQ(std::ranges::count(rows, row), 1);
    }
    EXPECT_EQ(rows[1].surfels, rows[0].surfels) << "links need no rays and vary fastest";
    EXPECT_NE(rows[1].links, rows[0].links);
}

TEST(SettingsSweep, NeighboursDifferByOneStepOfOneSetting) {
    BakeSettings row;
    row.surfels = 200;
    row.links = 8;
    const std::vector<BakeSettings> neighbours = neighboursIn(kSweep, row);
    ASSERT_EQ(neighbours.size(), 4U); // surfels 100 and 400, links 16, storage sh
    for (const BakeSettings& neighbour : neighbours)
        EXPECT_EQ((neighbour.surfels != row.surfels) + (neighbour.links != row.links) +
                      (neighbour.storage != row.storage),
                  1);
    row.surfels = 300; // not a value of the sweep
    EXPECT_EQ(neighboursIn(kSweep, row).size(), 2U);
    EXPECT_TRUE(neighboursIn({}, row).empty());
}

TEST(SettingsSweep, NamesSayWhatDiffersFromTheDefault) {
    BakeSettings s;
    EXPECT_EQ(settingsName(s), "default");
    s.surfels = 100;
    s.storage = LinkStorage::Sh;
    s.grid = {1, 2, 3};
    EXPECT_EQ(settingsName(s), "surfels 100, storage sh, grid 1x2x3");
}

} // namespace
} // namespace limn::settings_sweep_test
