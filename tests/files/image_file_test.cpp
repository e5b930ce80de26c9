// SPDX-License-Identifier: MIT
#include "engine/files/image_file.h"

#include "tests/core/full_disk.h"
#include "tests/gltf/gltf_builder.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace limn::image_file_test {
namespace {

ImageF randomImage(std::uint32_t width, std::uint32_t height) {
    ImageF image{width, height, {}};
    std::mt19937 random(width * 1000 + height);
    std::uniform_real_distribution<float> exponent(-30, 30);
    for (std::uint32_t i = 0; i < width * height; ++i)
        image.rgb.emplace_back(std::exp2(exponent(random)), float(i), -std::exp2(exponent(random)));
    return image;
}

TEST(ImageFile, AnExrComesBackBitForBit) {
    const TemporaryFolder folder;
    for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 2u}, {17u, 40u}, {200u, 1u}}) {
        const ImageF image = randomImage(width, height);
        ASSERT_TRUE(writeExr(folder.file("i.exr"), image));
        const Result<ImageF> again = readFloatImage(folder.file("i.exr"));
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_TRUE(*again == image) << width << " x " << height;
    }
}

TEST(ImageFile, AnExrKeepsExtremesInfinityAndNan) {
    const TemporaryFolder folder;
    const float inf = std::numeric_limits<float>::infinity();
    const ImageF image{2, 1, {{1e-45f, 3.4e38f, -0.f}, {inf, -inf, std::nanf("")}}};
    ASSERT_TRUE(writeExr(folder.file("i.exr"), image));
    const Result<ImageF> again = readFloatImage(folder.file("i.exr"));
    ASSERT_TRUE(again);
    EXPECT_EQ(std::memcmp(again->rgb.data(), image.rgb.data(), 2 * sizeof(glm::vec3)), 0);
}

TEST(ImageFile, AnRgbeFileIsReadAsLinear) {
    const TemporaryFolder folder;
    // 2 x 1 flat texels: mantissas of 128/256 at exponent 0, then of 64/256 at exponent 3.
    const std::string texels("\x80\x40\x20\x80\x40\x40\x40\x83", 8);
    writeFile(folder.file("i.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + texels);
    const Result<ImageF> image = readFloatImage(folder.file("i.hdr"));
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->width, 2u);
    EXPECT_EQ(image->rgb[0], glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_EQ(image->rgb[1], glm::vec3(2));
}

/// 8 x 2 texels: a packed row of runs and single bytes, then a plain one.
std::string packedHdr() {
    std::string hdr = "#?RGBE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1\n\n-Y 2 +X 8\n";
    hdr += std::string("\2\2\0\x08", 4);                   // a packed row of 8
    hdr += "\x88\x80";                                     // red: eight times 128
    hdr += std::string("\x83\0\5\x80\x80\x80\x80\x40", 8); // green: three zeros, five others
    hdr += "\x84\x20\x84\x10";                             // blue: twice four
    hdr += "\x88\x81";                                     // exponent 1
    for (int i = 0; i < 8; ++i)
        hdr += "\x80\x40\x20\x80";
    return hdr;
}

TEST(ImageFile, RowsOfAnRgbeFileMayBePacked) {
    const TemporaryFolder folder;
    writeFile(folder.file("i.hdr"), packedHdr());
    const Result<ImageF> image = readFloatImage(folder.file("i.hdr"));
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->rgb.size(), 16u);
    EXPECT_EQ(image->rgb[0], glm::vec3(1, 0, 0.25f));
    EXPECT_EQ(image->rgb[3], glm::vec3(1, 1, 0.25f));
    EXPECT_EQ(image->rgb[7], glm::vec3(1, 0.5f, 0.125f));
    EXPECT_EQ(image->rgb[8], glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_EQ(image->rgb[15], image->rgb[8]);
}

/// Rows from the bottom, columns from the right, lines that end as on Windows, and texels that were
/// multiplied before they were written.
TEST(ImageFile, AnRgbeFileSaysHowItsTexelsAreMeant) {
    const TemporaryFolder folder;
    const std::string texels("\x80\x40\x20\x80\x40\x40\x40\x83", 8);
    const auto read = [&](const std::string& header) {
        writeFile(folder.file("i.hdr"), header + texels);
        const Result<ImageF> image = readFloatImage(folder.file("i.hdr"));
        EXPECT_TRUE(image) << image.error().message;
        return image ? image->rgb : std::vector<glm::vec3>(2);
    };
    const std::string start = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";
    const glm::vec3 a(0.5f, 0.25f, 0.125f), b(2);
    using Texels = std::vector<glm::vec3>;
    EXPECT_EQ(read(start + "\n-Y 1 -X 2\n"), Texels({b, a}));
    EXPECT_EQ(read(start + "\n+Y 2 +X 1\n"), Texels({b, a}));
    EXPECT_EQ(read("#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n-Y 1 +X 2\r\n"), Texels({a, b}));
    EXPECT_EQ(read(start + "EXPOSURE=2\nEXPOSURE= 2.0\n\n-Y 1 +X 2\n"), Texels({a / 4.f, b / 4.f}));
    EXPECT_EQ(read(start + "COLORCORR=1 2 4\n\n-Y 1 +X 2\n"),
              Texels({{0.5f, 0.125f, 0.03125f}, {2, 1, 0.5f}}));
    const auto problem = [&](const std::string& header) {
        writeFile(folder.file("i.hdr"), header + texels);
        const Result<ImageF> image = readFloatImage(folder.file("i.hdr"));
        return image ? "" : image.error().message;
    };
    EXPECT_NE(problem(start + "\n+X 2 -Y 1\n").find("columns"), std::string::npos);
    EXPECT_NE(problem(start + "EXPOSURE=0\n\n-Y 1 +X 2\n").find("EXPOSURE"), std::string::npos);
    EXPECT_NE(problem("#?RGBE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 2\n").find("XYZ"),
              std::string::npos);
}

// stb 2.27 waits for ever for the rest of a packed row, and makes up that of a plain one.
TEST(ImageFile, AnRgbeFileThatEndsTooSoonIsRefused) {
    const TemporaryFolder folder;
    const std::string whole = packedHdr();
    for (std::size_t length = 0; length < whole.size(); ++length) {
        writeFile(folder.file("i.hdr"), whole.substr(0, length));
        EXPECT_FALSE(readFloatImage(folder.file("i.hdr"))) << length;
    }
    const std::size_t row = whole.find("\x88");
    for (const char run : {'\x89', '\0', '\x09'}) { // 9, 0 and 9 of 8 texels
        std::string bad = whole;
        bad[row] = run;
        writeFile(folder.file("i.hdr"), bad);
        const Result<ImageF> image = readFloatImage(folder.file("i.hdr"));
        ASSERT_FALSE(image);
        EXPECT_NE(image.error().message.find("i.hdr: malformed HDR"), std::string::npos);
    }
    for (const char* size :
         {"-Y 0 +X 8", "-Y 2 +X -8", "*Y 2 +X 8", "-Y 2", "-Y 2 +X 99999999999"}) {
        std::string bad = whole;
        bad.replace(bad.find("-Y"), 9, size);
        writeFile(folder.file("i.hdr"), bad);
        EXPECT_FALSE(readFloatImage(folder.file("i.hdr"))) << size;
    }
}

TEST(ImageFile, APngComesBackBitForBit) {
    const TemporaryFolder folder;
    Image image{"i.png", 5, 3, {}};
    for (int i = 0; i < 60; ++i)
        image.rgba.push_back(std::uint8_t(i * 37));
    ASSERT_TRUE(writePng(folder.file("i.png"), image));
    const Result<Image> again = readPng(folder.file("i.png"));
    ASSERT_TRUE(again);
    EXPECT_TRUE(*again == image);
}

TEST(ImageFile, FailuresNameTheFile) {
    const TemporaryFolder folder;
    writeFile(folder.file("text.exr"), "not an image");
    EXPECT_NE(readFloatImage(folder.file("text.exr")).error().message.find("text.exr"),
              std::string::npos);
    EXPECT_NE(readPng(folder.file("no.png")).error().message.find("no such file"),
              std::string::npos);
    EXPECT_NE(readPng(folder.path.string()).error().message.find("not a regular file"),
              std::string::npos);
    const Result<void> written = writeExr(folder.file("no/where.exr"), randomImage(2, 2));
    ASSERT_FALSE(written);
    EXPECT_NE(written.error().message.find("where.exr: cannot create"), std::string::npos);
    EXPECT_FALSE(writePng(folder.file("empty.png"), Image{}));
    EXPECT_FALSE(writeExr(folder.file("empty.exr"), ImageF{}));
}

TEST(ImageFile, FewBytesNeverBecomeManyPixels) {
    const TemporaryFolder folder;
    const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
    writeFile(folder.file("i.hdr"), head + "-Y 16000 +X 16000\n");
    EXPECT_NE(readFloatImage(folder.file("i.hdr")).error().message.find("truncated HDR"),
              std::string::npos);
    writeFile(folder.file("i.hdr"), head + "-Y 1000 +X 1000\n" + std::string(4000000, '\x80'));
    EXPECT_TRUE(readFloatImage(folder.file("i.hdr")));
    EXPECT_NE(
        readFloatImage(folder.file("i.hdr"), {10 << 20})
            .error()
            .message.find("i.hdr: the picture would need 11.4 MiB of memory, 10 MiB are allowed"),
        std::string::npos);
    ASSERT_TRUE(writeExr(folder.file("i.exr"), ImageF{400, 300, std::vector<glm::vec3>(120000)}));
    EXPECT_NE(readFloatImage(folder.file("i.exr"), {1 << 20}).error().message.find("would need"),
              std::string::npos);
}

TEST(ImageFile, APictureThatCannotBeWrittenLeavesTheOldOne) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writeExr(folder.file("i.exr"), randomImage(3, 3)));
    const std::string before = fileBytes(folder.file("i.exr"));
    {
        const FullDisk full(1 << 12);
        EXPECT_FALSE(writeExr(folder.file("i.exr"), randomImage(100, 100)));
    }
    EXPECT_EQ(fileBytes(folder.file("i.exr")), before);
}

/// Whatever the bytes, the reader answers; what it accepts is whole.
void expectAnswer(const TemporaryFolder& folder, const std::string& bytes) {
    writeFile(folder.file("damaged"), bytes);
    if (const Result<ImageF> image = readFloatImage(folder.file("damaged"))) {
        EXPECT_EQ(image->rgb.size(), std::size_t(image->width) * image->height);
    }
    if (const Result<Image> image = readPng(folder.file("damaged"))) {
        EXPECT_EQ(image->rgba.size(), std::size_t(image->width) * image->height * 4);
    }
}

TEST(ImageFile, DamagedFilesNeverCrash) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writeExr(folder.file("i.exr"), randomImage(19, 21)));
    ASSERT_TRUE(writePng(folder.file("i.png"), Image{"", 4, 4, std::vector<std::uint8_t>(64, 7)}));
    std::mt19937 random(11);
    for (const char* name : {"i.exr", "i.png"}) {
        const std::string whole = fileBytes(folder.file(name));
        for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 100)
            expectAnswer(folder, whole.substr(0, length));
        for (int round = 0; round < 200; ++round) {
            std::string bytes = whole;
            // The header is where the sizes are.
            const std::size_t reach =
                round % 2 ? bytes.size() : std::min<std::size_t>(400, bytes.size());
            for (int flips = 1 + int(random() % 3); flips > 0; --flips)
                bytes[random() % reach] = char(random());
            expectAnswer(folder, bytes);
        }
    }
}

} // namespace
} // namespace limn::image_file_test
