// SPDX-License-Identifier: MIT
#include "editor_ui/view/icon_scales.h"

#include <cstddef>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::icon_scales_test {
namespace {

TEST(IconScales, IconsApartKeepTheirSizeAndNeighboursTouch) {
    EXPECT_TRUE(iconScales({}, 24).empty());
    EXPECT_EQ(iconScales({{5, 5}}, 24), std::vector<float>{1});
    EXPECT_EQ(iconScales({{0, 0}, {24, 0}}, 24), (std::vector<float>{1, 1}));
    EXPECT_EQ(iconScales({{0, 0}, {12, 0}, {100, 0}}, 24), (std::vector<float>{0.5f, 0.5f, 1}));
    EXPECT_EQ(iconScales({{0, 0}, {1, 0}}, 24), (std::vector<float>{0.25f, 0.25f}));
    EXPECT_EQ(iconScales({{7, 7}, {7, 7}}, 24), (std::vector<float>{1, 1})) << "drawn as one";
}

// 500 lamps of a hall: as full-size icons they cover one another.
TEST(IconScales, NoTwoIconsOfACrowdOverlapUnlessTheyAreAlreadySmallest) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> across(-400, 400);
    std::vector<glm::vec2> places;
    for (int i = 0; i < 500; ++i)
        places.emplace_back(across(random), across(random));
    const std::vector<float> scales = iconScales(places, 24);
    std::size_t shrunk = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        shrunk += scales[i] < 1;
        for (std::size_t j = 0; j < i; ++j) {
            const float reach = 12 * (scales[i] + scales[j]);
            const bool smallest = scales[i] == kMinIconScale || scales[j] == kMinIconScale;
            const float apart = glm::length(places[i] - places[j]) + 1e-3f;
            EXPECT_TRUE(smallest || reach <= apart) << i << ' ' << j;
        }
    }
    EXPECT_GT(shrunk, 100U);
    EXPECT_LT(shrunk, 500U);
}

} // namespace
} // namespace limn::icon_scales_test
