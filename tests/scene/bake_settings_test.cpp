// SPDX-License-Identifier: MIT
#include "engine/scene/bake_settings.h"

#include "engine/scene/bake_settings_fields.h"
#include "engine/scene/setting_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include <fmt/format.h>

namespace limn::bake_settings_test {

TEST(BakeSettings, EverySettingIsNamedOnceAndExplained) {
    std::set<std::string> keys, flags;
    const BakeSettings s;
    visitBakeSettings(s, [&](const Setting& setting, const auto&, const auto&...) {
        EXPECT_TRUE(keys.insert(setting.key).second) << setting.key;
        ASSERT_TRUE(setting.label && setting.tooltip) << setting.key;
        EXPECT_GT(std::string(setting.tooltip).size(), 10U) << setting.key;
        ASSERT_TRUE(setting.flag && setting.help) << setting.key;
        EXPECT_TRUE(flags.insert(setting.flag).second) << setting.flag;
        EXPECT_LE(setting.group, kLastSettingGroup);
    });
    EXPECT_EQ(settingsDefect(s), "");
}

/// Sets every number of a setting's value.
template <class T>
void setAll(T& value, double number) {
    if constexpr (requires { value.x; })
        value = T(std::uint32_t(number));
    else
        value = T(number);
}

TEST(BakeSettings, NumbersBeyondTheirRangeAreDefectsThatNameTheSetting) {
    BakeSettings defaults;
    visitBakeSettings(defaults, [](const Setting& setting, auto& shared, const auto&... limits) {
        if constexpr ((std::is_same_v<std::decay_t<decltype(limits)>, SettingRange> && ...) &&
                      sizeof...(limits) == 1) {
            const SettingRange range = (limits, ...);
            const auto defectAt = [&](double number) {
                BakeSettings s;
                if (setting.key == std::string_view("texelsPerMetre"))
                    s.lightmapCaches = 0;
                visitBakeSettings(s, [&](const Setting& other, auto& value, const auto&...) {
                    if constexpr (std::is_same_v<decltype(value), decltype(shared)>)
                        if (other.key == std::string_view(setting.key))
                            setAll(value, number);
                });
                return settingsDefect(s);
            };
            EXPECT_EQ(defectAt(range.lowest), "") << setting.key;
            EXPECT_EQ(defectAt(range.upper), "") << setting.key;
            const auto named = [&](const std::string& defect) {
                return defect.find(std::string("bake settings: ") + setting.key) == 0;
            };
            EXPECT_TRUE(named(defectAt(range.upper * 1.5 + 1))) << setting.key;
            if (range.lower > 0) {
                EXPECT_TRUE(named(defectAt(range.lower - 1))) << setting.key;
            }
            if constexpr (std::is_same_v<std::decay_t<decltype(shared)>, float>) {
                EXPECT_TRUE(named(defectAt(std::numeric_limits<double>::quiet_NaN())));
            }
        }
    });
}

TEST(BakeSettings, UnknownChoicesAndHalfAGridAreDefects) {
    BakeSettings s;
    s.cut = CutCriterion(7);
    EXPECT_EQ(settingsDefect(s), "bake settings: cut is unknown");
    s = {};
    s.grid = {4, 0, 4};
    EXPECT_NE(settingsDefect(s).find("grid 4x0x4"), std::string::npos);
    s = {};
    s.lightmapCaches = 0;
    EXPECT_NE(settingsDefect(s).find("texelsPerMetre"), std::string::npos);
}

TEST(BakeSettings, TextSetsWhatItNamesAndTellsWhatIsWrong) {
    BakeSettings s;
    EXPECT_EQ(setBakeSetting(s, "rays", "512"), "");
    EXPECT_EQ(s.rays, 512U);
    EXPECT_EQ(setBakeSetting(s, "storage", "sh"), "");
    EXPECT_EQ(s.storage, LinkStorage::Sh);
    EXPECT_EQ(setBakeSetting(s, "grid", "3x4x5"), "");
    EXPECT_EQ(s.grid, glm::uvec3(3, 4, 5));
    EXPECT_EQ(setBakeSetting(s, "clusterNormalWeight", "0.25"), "");
    EXPECT_EQ(s.clusterNormalWeight, 0.25f);

    const BakeSettings before = s;
    EXPECT_EQ(setBakeSetting(s, "rays", "15"), "15 is outside [16, 65536]");
    for (const char* text : {"", "12x", "-1", " 64", "0x40", "1e3", "99999999999999999999", "nan"})
        EXPECT_NE(setBakeSetting(s, "rays", text), "") << text;
    for (const char* text : {"3x4", "3x4x", "x3x4", "3x4x5x6", "0x1x1", "257x1x1", "3 x4x5"})
        EXPECT_NE(setBakeSetting(s, "grid", text), "") << text;
    for (const char* text : {"nan", "inf", "-0.1", "101"})
        EXPECT_NE(setBakeSetting(s, "clusterNormalWeight", text), "") << text;
    EXPECT_EQ(setBakeSetting(s, "cut", "best"), "\"best\" is not one of detail, solid-angle");
    EXPECT_EQ(s, before);
}

TEST(BakeSettings, TextForTheLightmapsSizeReplacesItsDensity) {
    BakeSettings s;
    s.texelsPerMetre = 4;
    s.lightmapCaches = 0;
    EXPECT_EQ(setBakeSetting(s, "lightmapCaches", "500"), "");
    EXPECT_EQ(s.texelsPerMetre, 0);
    EXPECT_EQ(s.lightmapCaches, 500U);
}

} // namespace limn::bake_settings_test
