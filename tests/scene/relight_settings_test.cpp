// SPDX-License-Identifier: MIT
#include "engine/scene/relight_settings.h"

#include <gtest/gtest.h>

#include <set>

namespace limn::relight_settings_test {

TEST(RelightSettings, EverySettingIsNamedOnceAndExplainedAndAsksForNoBake) {
    std::set<std::string> keys, flags;
    const RelightSettings defaults;
    visitRelightSettings(defaults, [&](const Setting& setting, auto&, const auto&...) {
        EXPECT_TRUE(keys.insert(setting.key).second) << setting.key;
        ASSERT_TRUE(setting.flag && setting.label && setting.help && setting.tooltip);
        EXPECT_TRUE(flags.insert(setting.flag).second) << setting.flag;
        EXPECT_EQ(setting.invalidates, Invalidates::Light) << setting.key;
    });
    EXPECT_EQ(settingsDefect(defaults), "");
}

TEST(RelightSettings, NumbersBeyondTheirRangeAreDefectsThatNameTheSetting) {
    EXPECT_EQ(settingsDefect({.maxBounces = 0}),
              "relight settings: maxBounces 0 is outside [1, 10000]");
    EXPECT_EQ(settingsDefect({.maxBounces = 10001}),
              "relight settings: maxBounces 10001 is outside [1, 10000]");
    EXPECT_EQ(settingsDefect({.maxBounces = 1}), "");
    EXPECT_EQ(settingsDefect({.tolerance = 0}),
              "relight settings: tolerance 0 is outside [0.001, 10]");
}

TEST(RelightSettings, TextSetsWhatItNamesAndTellsWhatIsWrong) {
    RelightSettings s;
    EXPECT_EQ(setRelightSetting(s, "maxBounces", "7"), "");
    EXPECT_EQ(setRelightSetting(s, "tolerance", "0.5"), "");
    EXPECT_EQ(setRelightSetting(s, "dynamicOcclusion", "false"), "");
    const RelightSettings expected{.maxBounces = 7, .tolerance = 0.5f, .dynamicOcclusion = false};
    EXPECT_EQ(s, expected);
    for (const char* text : {"0", "10001", "-1", "1.5", "", "many"})
        EXPECT_NE(setRelightSetting(s, "maxBounces", text), "") << text;
    EXPECT_NE(setRelightSetting(s, "dynamicOcclusion", "yes"), "");
    EXPECT_NE(setRelightSetting(s, "tolerance", "nan"), "");
    EXPECT_EQ(s, expected);
}

} // namespace limn::relight_settings_test
