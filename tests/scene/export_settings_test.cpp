// SPDX-License-Identifier: MIT
#include "engine/scene/export_settings_fields.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace limn::export_settings_test {
namespace {

bool applies(const ExportSettings& settings, std::string_view key) {
    bool does = false;
    visitExportSettings(settings, [&](const Setting& setting, const auto&, const auto&...) {
        if (setting.key == key)
            does = setting.applies;
    });
    return does;
}

TEST(ExportSettings, CompressionAppliesWhereAFileIsKtx2) {
    EXPECT_FALSE(applies({.format = "gltf"}, "compress"));
    EXPECT_TRUE(applies({.format = "gltf", .encoding = TextureEncoding::Ktx2Rgb9e5}, "compress"));
    EXPECT_TRUE(applies({.format = "grid"}, "compress")); // the grid is never an EXR
    EXPECT_TRUE(applies({.format = "three"}, "compress"));
}

TEST(ExportSettings, LayersApplyToHarmonics) {
    EXPECT_FALSE(applies({.bands = 1}, "layers"));
    EXPECT_TRUE(applies({.bands = 2}, "layers"));
}

TEST(ExportSettings, WithoutEffectSayWhatTheyNeed) {
    EXPECT_NE(missingFor({.format = "gltf"}, "compress").find("--encoding"), std::string::npos);
    EXPECT_NE(missingFor({}, "layers").find("--lightmap-bands"), std::string::npos);
    EXPECT_EQ(missingFor({.encoding = TextureEncoding::Ktx2Half}, "compress"), "");
    EXPECT_EQ(missingFor({}, "encoding"), "");
}

TEST(ExportSettings, CompressionForThreeNeedsAGridOrAKtx2Lightmap) {
    constexpr bool kNoGrid = false;
    EXPECT_NE(missingFor({.format = "three"}, "compress", kNoGrid), "");
    EXPECT_EQ(missingFor({.format = "three"}, "compress"), "");
    EXPECT_EQ(missingFor({.format = "three", .bands = 3}, "compress", kNoGrid), "");
    EXPECT_NE(missingFor({.format = "gltf", .bands = 3}, "compress", kNoGrid), "");
}

TEST(ExportSettings, ADensityTakesThePlaceOfANumberOfTexels) {
    ExportSettings settings{.texelsPerMetre = 8};
    EXPECT_FALSE(applies(settings, "texels"));
    EXPECT_EQ(setExportSetting(settings, "texels", "9"), "");
    EXPECT_EQ(settings.texelsPerMetre, 0);
    EXPECT_TRUE(applies(settings, "texels"));
    EXPECT_EQ(setExportSetting(settings, "texelsPerMetre", "0.5"), "");
    EXPECT_FALSE(applies(settings, "texels"));
    settings.quality = LightmapQuality::Draft;
    EXPECT_FALSE(applies(settings, "texelsPerMetre"));
}

TEST(ExportSettings, EveryOneHasAKeyAndAFlagOfItsOwn) {
    std::set<std::string> keys, flags;
    int count = 0;
    const ExportSettings defaults;
    visitExportSettings(defaults, [&](const Setting& setting, const auto&, const auto&...) {
        ++count;
        keys.insert(setting.key);
        flags.insert(setting.flag);
    });
    EXPECT_EQ(keys.size(), std::size_t(count));
    EXPECT_EQ(flags.size(), std::size_t(count));
}

TEST(ExportSettings, ADefectNamesTheFlag) {
    EXPECT_EQ(settingsDefect(ExportSettings{}), "");
    EXPECT_TRUE(settingsDefect({.detail = 2}).starts_with("--detail"));
    EXPECT_TRUE(settingsDefect({.maxSize = 1}).starts_with("--max-size"));
}

} // namespace
} // namespace limn::export_settings_test
