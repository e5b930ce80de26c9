// SPDX-License-Identifier: MIT
#include "engine/scene/decode_image.h"

#include "tests/scene/small_png.h"

#include <string>

#include <gtest/gtest.h>

namespace limn {
namespace {

std::vector<std::uint8_t> bytesOf(const std::string& text) {
    return {text.begin(), text.end()};
}

std::string problem(const std::vector<std::uint8_t>& bytes) {
    const Result<Image> image = decodeImage(bytes);
    return image ? "" : image.error().message;
}

TEST(DecodeImage, ReadsAPng) {
    const Result<Image> image = decodeImage(greyPng());
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, 1u);
    EXPECT_EQ(image->rgba, (std::vector<std::uint8_t>{128, 128, 128, 255}));
}

// stb reads all of these: of the first one past its end, and gigabytes for the second.
TEST(DecodeImage, ReadsNothingThatGltfDoesNotHave) {
    const std::string ppm = "P6 2 2 65535\n" + std::string(24, 'x');
    std::string tga(33, '\0');
    tga[2] = 2; // true colour, of 65 535 x 65 535 texels
    tga[12] = tga[13] = tga[14] = tga[15] = '\xff';
    tga[16] = 32;
    const std::string bmp = "BM" + std::string(52, '\0');
    for (const std::string& bytes :
         {ppm, tga, bmp, std::string("GIF89a"), std::string("8BPS"), std::string("\x89PN")})
        EXPECT_EQ(problem(bytesOf(bytes)), "is neither PNG nor JPEG") << bytes.substr(0, 4);
    EXPECT_EQ(problem({}), "is missing");
}

TEST(DecodeImage, RefusesSizesBeforeItAllocates) {
    std::vector<std::uint8_t> png = greyPng();
    const auto resize = [&](std::uint8_t width, std::uint8_t height) { // in units of 256 texels
        png[18] = width;
        png[22] = height;
    };
    resize(0x7f, 0x7f); // 32 k x 32 k
    EXPECT_EQ(problem(png), "is too large");
    resize(0x3f, 0x3f); // 16 k x 16 k, which 67 bytes cannot hold
    EXPECT_EQ(problem(png), "is damaged");
}

TEST(DecodeImage, DamagedOnesAreRefused) {
    std::vector<std::uint8_t> png = greyPng();
    for (std::size_t size = 0; size + 12 < png.size(); ++size) // the last chunk is empty
        EXPECT_NE(problem({png.begin(), png.begin() + std::ptrdiff_t(size)}), "") << size;
}

} // namespace
} // namespace limn
