// SPDX-License-Identifier: MIT
#include "engine/core/process_memory.h"
#include "engine/scene/decode_image.h"

#include "tests/scene/small_ktx2.h"
#include "tests/scene/small_png.h"

#include <array>
#include <string>

#include <gtest/gtest.h>
#include <turbojpeg.h>

namespace limn::decode_image_test {
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

// A reader that tries more formats read past the end of the first, and took gigabytes for the
// second.
TEST(DecodeImage, ReadsNothingThatGltfDoesNotHave) {
    const std::string ppm = "P6 2 2 65535\n" + std::string(24, 'x');
    std::string tga(33, '\0');
    tga[2] = 2; // true colour, of 65 535 x 65 535 texels
    tga[12] = tga[13] = tga[14] = tga[15] = '\xff';
    tga[16] = 32;
    const std::string bmp = "BM" + std::string(52, '\0');
    for (const std::string& bytes :
         {ppm, tga, bmp, std::string("GIF89a"), std::string("8BPS"), std::string("\x89PN")})
        EXPECT_EQ(problem(bytesOf(bytes)), "is neither PNG, JPEG, WebP nor KTX2")
            << bytes.substr(0, 4);
    EXPECT_EQ(problem({}), "is missing");
}

TEST(DecodeImage, ReadsKtx2OfBytes) {
    using Rgba = std::vector<std::uint8_t>;
    for (const std::uint32_t packing : {0U, 2U}) {
        const auto read = [&](std::uint32_t format, const std::string& texels) {
            const Result<Image> image = decodeImage(ktx2(format, 2, 1, texels, packing));
            EXPECT_TRUE(image) << image.error().message;
            return image ? image->rgba : Rgba();
        };
        EXPECT_EQ(read(9, "\1\2"), (Rgba{1, 1, 1, 255, 2, 2, 2, 255}));
        EXPECT_EQ(read(29, "\1\2\3\4\5\6"), (Rgba{1, 2, 3, 255, 4, 5, 6, 255}));
        EXPECT_EQ(read(43, "\1\2\3\4\5\6\7\x8"), (Rgba{1, 2, 3, 4, 5, 6, 7, 8}));
        EXPECT_EQ(read(44, "\1\2\3\4\5\6\7\x8"), (Rgba{3, 2, 1, 4, 7, 6, 5, 8}));
    }
}

/// A block of BC1 whose four colours are two ends, in 5, 6 and 5 bits, and their thirds; one of BC3
/// has alphas before it.
TEST(DecodeImage, ReadsKtx2OfBlocks) {
    const std::string colors("\x00\xf8\x1f\x00\xe4\xe4\xe4\xe4",
                             8); // red, blue; 0, 1, 2, 3 in each row
    const Result<Image> image = decodeImage(ktx2(132, 5, 3, colors + colors));
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->rgba.size(), 60U);
    const int red[5] = {255, 0, 170, 85, 255}, blue[5] = {0, 255, 85, 170, 0};
    for (std::size_t i = 0; i < 15; ++i) {
        EXPECT_NEAR(image->rgba[4 * i], red[i % 5], 1) << i;
        EXPECT_EQ(image->rgba[4 * i + 1], 0) << i;
        EXPECT_NEAR(image->rgba[4 * i + 2], blue[i % 5], 1) << i;
        EXPECT_EQ(image->rgba[4 * i + 3], 255) << i;
    }
    const std::string alphas("\x40\x80\0\0\0\0\0\0", 8); // all texels have the first
    const Result<Image> clear = decodeImage(ktx2(137, 4, 4, alphas + colors, 2));
    ASSERT_TRUE(clear) << clear.error().message;
    EXPECT_EQ(clear->rgba[3], 0x40);
    EXPECT_NEAR(clear->rgba[4 * 3], 85, 1);
}

TEST(DecodeImage, NamesTheKtx2ThatItDoesNotRead) {
    const std::string texels(64, '\0');
    EXPECT_EQ(problem(ktx2(0, 4, 4, texels, 1)),
              "is KTX2 of Basis Universal (ETC1S), which is not read");
    EXPECT_EQ(problem(ktx2(0, 4, 4, texels)),
              "is KTX2 of Basis Universal (UASTC), which is not read");
    EXPECT_EQ(problem(ktx2(145, 4, 4, texels)), "is KTX2 of BC7, which is not read");
    EXPECT_EQ(problem(ktx2(151, 4, 4, texels)), "is KTX2 of ETC2, which is not read");
    EXPECT_EQ(problem(ktx2(157, 4, 4, texels)), "is KTX2 of ASTC, which is not read");
    EXPECT_EQ(problem(ktx2(97, 4, 4, texels)), "is KTX2 of Vulkan's format 97, which is not read");
    const std::vector<std::uint8_t> whole = ktx2(37, 4, 4, texels, 2);
    ASSERT_EQ(problem(whole), "");
    for (std::size_t length = 12; length < whole.size(); ++length)
        EXPECT_EQ(problem({whole.begin(), whole.begin() + std::ptrdiff_t(length)}), "is damaged");
    EXPECT_EQ(problem(ktx2(37, 5, 4, texels)), "is damaged");
    EXPECT_EQ(problem(ktx2(37, 1 << 15, 1 << 15, texels)), "is damaged");
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

/// Four inks, as Adobe's programs store them: what each leaves of the paper.
TEST(DecodeImage, InksBecomeTheColourThatTheyLeave) {
    std::vector<std::uint8_t> inks;
    for (int i = 0; i < 64; ++i)
        inks.insert(inks.end(), {200, 40, 90, std::uint8_t(i < 32 ? 255 : 128)});
    const tjhandle jpeg = tjInitCompress();
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    ASSERT_EQ(tjCompress2(jpeg, inks.data(), 8, 0, 8, TJPF_CMYK, &bytes, &size, TJSAMP_444, 100, 0),
              0);
    const Result<Image> image = decodeImage({bytes, size});
    tjFree(bytes);
    tjDestroy(jpeg);
    ASSERT_TRUE(image) << image.error().message;
    const auto expectNear = [&](std::size_t texel, std::array<int, 4> expected) {
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_NEAR(image->rgba[4 * texel + c], expected[c], 3) << texel << ' ' << c;
    };
    expectNear(0, {200, 40, 90, 255});
    expectNear(63, {100, 20, 45, 255});
}

TEST(DecodeImage, DamagedOnesAreRefused) {
    std::vector<std::uint8_t> png = greyPng();
    constexpr std::size_t kTexelsEnd = 51; // behind them are checksums and an empty chunk
    for (std::size_t size = 0; size < kTexelsEnd; ++size)
        EXPECT_NE(problem({png.begin(), png.begin() + std::ptrdiff_t(size)}), "") << size;
}

TEST(DecodeImage, APngChunkLiesWithinTheFile) {
    std::vector<std::uint8_t> png = greyPng();
    constexpr std::size_t kDataLength = 33; // of IDAT
    png[kDataLength] = 0x3f;
    EXPECT_EQ(problem(png), "is damaged");
    png = greyPng();
    png.insert(png.end(), 9, 0xff); // behind the last chunk nobody looks
    EXPECT_EQ(problem(png), "");
}

/// A zlib stream of 1 + 258 * matches zeros in 13 bits per 258: RFC 1951, 3.2.6.
std::vector<std::uint8_t> packedZeros(std::size_t matches) {
    std::vector<std::uint8_t> out = {0x78, 0x01};
    std::uint32_t bits = 0;
    int count = 0;
    const auto put = [&](std::uint32_t value, int size) {
        bits |= value << count;
        for (count += size; count >= 8; count -= 8, bits >>= 8)
            out.push_back(std::uint8_t(bits));
    };
    put(0b011, 3);      // the last block, of fixed codes
    put(0b00001100, 8); // a zero; codes begin with their highest bit
    for (std::size_t i = 0; i < matches; ++i) {
        put(0b10100011, 8); // 258 bytes
        put(0, 5);          // as the one before
    }
    put(0, 7 + 8); // the end
    out.insert(out.end(), 4, 0);
    return out;
}

void insertChunk(std::vector<std::uint8_t>& png, std::size_t at, const std::string& name,
                 const std::vector<std::uint8_t>& data) {
    std::vector<std::uint8_t> chunk;
    for (const int shift : {24, 16, 8, 0})
        chunk.push_back(std::uint8_t(data.size() >> shift));
    chunk.insert(chunk.end(), name.begin(), name.end());
    chunk.insert(chunk.end(), data.begin(), data.end());
    chunk.insert(chunk.end(), 4, 0);
    png.insert(png.begin() + std::ptrdiff_t(at), chunk.begin(), chunk.end());
}

// stb would unpack all of it before it looked how many texels there are.
TEST(DecodeImage, APngUnpacksNoMoreThanItsTexelsAndSomeText) {
    constexpr std::size_t kHeaderEnd = 33, kDataEnd = 55;
    const std::vector<std::uint8_t> zeros = packedZeros(2'000'000); // 516 MB in 3 MB
    std::vector<std::uint8_t> bomb = greyPng();
    bomb.erase(bomb.begin() + kHeaderEnd, bomb.begin() + kDataEnd);
    insertChunk(bomb, kHeaderEnd, "IDAT", zeros);
    std::vector<std::uint8_t> text = greyPng(), data = {'a', 0, 0};
    data.insert(data.end(), zeros.begin(), zeros.end());
    insertChunk(text, kHeaderEnd, "zTXt", data);
    const std::uint64_t before = peakMemory();
    const Result<Image> black = decodeImage(bomb);
    ASSERT_TRUE(black);
    EXPECT_EQ(black->rgba, (std::vector<std::uint8_t>{0, 0, 0, 255}));
    EXPECT_EQ(problem(text), "is damaged");
    EXPECT_LT(peakMemory() - before, 200'000 * 1024);
}

TEST(DecodeImage, SixteenBitsPalettesAndTransparencyBecomeRgba) {
    const auto with = [](std::uint8_t depth, std::uint8_t color, const char* before,
                         const std::vector<std::uint8_t>& extra) {
        std::vector<std::uint8_t> png = greyPng();
        png.erase(png.begin() + 33, png.begin() + 55);
        png[24] = depth;
        png[25] = color;
        insertChunk(png, 33, "IDAT", packedZeros(1));
        if (color == 3)
            insertChunk(png, 33, "tRNS", {7});
        insertChunk(png, 33, before, extra);
        const Result<Image> image = decodeImage(png);
        return image ? image->rgba : std::vector<std::uint8_t>{};
    };
    using Texel = std::vector<std::uint8_t>;
    EXPECT_EQ(with(8, 3, "PLTE", {10, 20, 30}), (Texel{10, 20, 30, 7}));
    EXPECT_EQ(with(16, 6, "gAMA", {0, 0, 0xb1, 0x8f}), (Texel{0, 0, 0, 0}));
    EXPECT_EQ(with(1, 0, "tRNS", {0, 0}), (Texel{0, 0, 0, 0}));
}

} // namespace
} // namespace limn::decode_image_test
