// SPDX-License-Identifier: MIT
#include "engine/export/lightmap_file.h"

#include "engine/files/ktx2.h"

#include <gtest/gtest.h>

namespace limn::lightmap_file_test {
namespace {

LightmapImage image(std::uint32_t layers, glm::vec3 value) {
    return {2, 1, layers, std::vector<glm::vec3>(2 * layers, value)};
}

Ktx2Shape shapeOf(const ExportFile& file) {
    const auto shape = readKtx2Shape(
        {reinterpret_cast<const std::uint8_t*>(file.bytes.data()), file.bytes.size()});
    EXPECT_TRUE(shape);
    return shape ? *shape : Ktx2Shape();
}

} // namespace

TEST(LightmapFile, SettingsChooseTheEncoding) {
    ExportSettings settings;
    settings.encoding = TextureEncoding::Ktx2Rgb9e5;
    settings.compress = true;
    const auto file = lightmapFile(image(1, glm::vec3(1)), settings, "room");
    ASSERT_TRUE(file);
    EXPECT_EQ(file->name, "room.ktx2");
    EXPECT_EQ(shapeOf(*file), (Ktx2Shape{Ktx2Format::Rgb9e5, 2, 1, 0, 0, true}));
    settings.encoding = TextureEncoding::Exr;
    EXPECT_EQ(lightmapFile(image(1, glm::vec3(1)), settings, "room")->name, "room.exr");
}

TEST(LightmapFile, HarmonicsAreAnArrayOrAVolume) {
    ExportSettings settings;
    settings.encoding = TextureEncoding::Ktx2Half;
    const LightmapImage harmonics = image(4, glm::vec3(-1));
    EXPECT_EQ(shapeOf(*lightmapFile(harmonics, settings, "room")).layers, 4U);
    settings.layers = ShLayers::Volume;
    EXPECT_EQ(shapeOf(*lightmapFile(harmonics, settings, "room")).depth, 4U);
}

TEST(LightmapFile, LightThatTheEncodingCannotHoldIsRefused) {
    ExportSettings settings;
    EXPECT_FALSE(lightmapFile(image(4, glm::vec3(1)), settings, "room")) << "harmonics in EXR";
    settings.encoding = TextureEncoding::Ktx2Rgb9e5;
    EXPECT_FALSE(lightmapFile(image(1, glm::vec3(-1)), settings, "room"));
    EXPECT_FALSE(lightmapFile(image(1, glm::vec3(65409)), settings, "room"));
    EXPECT_TRUE(lightmapFile(image(1, glm::vec3(65408)), settings, "room"));
    settings.encoding = TextureEncoding::Ktx2Half;
    EXPECT_FALSE(lightmapFile(image(1, glm::vec3(65505)), settings, "room"));
    EXPECT_FALSE(lightmapFile(image(4, glm::vec3(-65505)), settings, "room"));
    EXPECT_TRUE(lightmapFile(image(4, glm::vec3(-65504)), settings, "room"));
}

} // namespace limn::lightmap_file_test
