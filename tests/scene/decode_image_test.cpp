// SPDX-License-Identifier: MIT
#include "engine/scene/decode_image.h"
#include "engine/scene/image_check.h"

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

// stb would allocate a gigabyte before it found the file at its end.
TEST(DecodeImage, APngChunkLiesWithinTheFile) {
    std::vector<std::uint8_t> png = greyPng();
    constexpr std::size_t kDataLength = 33; // of IDAT
    png[kDataLength] = 0x3f;
    EXPECT_EQ(problem(png), "is damaged");
    png = greyPng();
    png.insert(png.end(), 9, 0xff); // behind the last chunk nobody looks
    EXPECT_EQ(problem(png), "");
}

/// A JPEG with nothing but a Huffman table of so many codes of 15 bits and as many of 16.
std::vector<std::uint8_t> jpegWithTable(std::uint8_t of15, std::uint8_t of16) {
    const unsigned length = 19U + of15 + of16;
    std::vector<std::uint8_t> jpeg = {
        0xff, 0xd8, 0xff, 0xc4, std::uint8_t(length >> 8), std::uint8_t(length), 0x13};
    jpeg.insert(jpeg.end(), 14, 0);
    jpeg.insert(jpeg.end(), {of15, of16});
    jpeg.insert(jpeg.end(), std::size_t(of15) + of16, 1);
    return jpeg;
}

// stb 2.27 decodes by a table that is missing as memory happens to be.
TEST(DecodeImage, AJpegScanHasItsTables) {
    const auto scanBy = [](std::uint8_t tables, std::uint8_t first, std::uint8_t last) {
        std::vector<std::uint8_t> jpeg = jpegWithTable(1, 1); // number 3 of those for AC
        jpeg.insert(jpeg.end(), {0xff, 0xda, 0, 8, 1, 1, tables, first, last, 0});
        return jpeg;
    };
    EXPECT_TRUE(jpegTablesFit(scanBy(0x13, 1, 63)));
    EXPECT_FALSE(jpegTablesFit(scanBy(0x12, 1, 63)));
    EXPECT_FALSE(jpegTablesFit(scanBy(0x13, 0, 63))); // there are none for DC
    EXPECT_FALSE(jpegTablesFit(scanBy(0x13, 0, 0)));
}

// stb 2.27 writes the codes of a longer table over what lies behind it.
TEST(DecodeImage, AJpegTableHasNoMoreCodesThanSymbols) {
    EXPECT_TRUE(jpegTablesFit(jpegWithTable(128, 128)));
    EXPECT_FALSE(jpegTablesFit(jpegWithTable(128, 129)));
    EXPECT_EQ(problem(jpegWithTable(128, 129)), "is damaged");

    std::vector<std::uint8_t> cut = jpegWithTable(255, 255);
    cut.resize(25); // within the counts of codes, or within the codes
    EXPECT_FALSE(jpegTablesFit(cut));
    std::vector<std::uint8_t> second = jpegWithTable(1, 1);
    const std::vector<std::uint8_t> table = jpegWithTable(255, 2);
    second.insert(second.end(), table.begin() + 2, table.end());
    EXPECT_FALSE(jpegTablesFit(second));

    // A scan's texels end where the decoder says.
    std::vector<std::uint8_t> scan = {0xff, 0xd8, 0xff, 0xda, 0x00, 0x40, 1, 2, 3};
    scan.insert(scan.end(), table.begin() + 2, table.end());
    EXPECT_FALSE(jpegTablesFit(scan));
    // What looks like a table may lie in a comment before that.
    std::vector<std::uint8_t> comment = {0xff, 0xd8, 0xff, 0xfe, 0x08, 0x00};
    comment.insert(comment.end(), table.begin() + 2, table.end());
    EXPECT_TRUE(jpegTablesFit(comment));
}

} // namespace
} // namespace limn
