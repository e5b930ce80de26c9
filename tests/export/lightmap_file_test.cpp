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

TEST(LightmapFile, BlocksTakeAnEighthOfHalfFloats) {
    ExportSettings settings;
    settings.encoding = TextureEncoding::Ktx2Bc6h;
    LightmapImage room{32, 12, 1, std::vector<glm::vec3>(std::size_t(32) * 12)};
    for (std::size_t i = 0; i < room.rgb.size(); ++i)
        room.rgb[i] = glm::vec3(2, 1, 0.5f) * (1 + 0.01f * float(i % 32));
    const ExportFile blocks = *lightmapFile(room, settings, "room");
    EXPECT_EQ(shapeOf(blocks), (Ktx2Shape{Ktx2Format::Bc6hUnsigned, 32, 12}));
    settings.encoding = TextureEncoding::Ktx2Half;
    const ExportFile halfs = *lightmapFile(room, settings, "room");
    EXPECT_EQ(halfs.bytes.size() - blocks.bytes.size(), std::size_t(32) * 12 * (8 - 1) + 48)
        << "a descriptor of one sample, not of four";
    settings.encoding = TextureEncoding::Ktx2Bc6h;
    EXPECT_FALSE(lightmapFile(image(1, glm::vec3(65505)), settings, "room"));
    const LightmapImage harmonics = image(4, glm::vec3(-1));
    EXPECT_EQ(shapeOf(*lightmapFile(harmonics, settings, "room")),
              (Ktx2Shape{Ktx2Format::Bc6hSigned, 2, 1, 4}));
    settings.layers = ShLayers::Volume;
    EXPECT_FALSE(lightmapFile(harmonics, settings, "room"));
}

} // namespace limn::lightmap_file_test
