// SPDX-License-Identifier: MIT
#include "engine/files/exr_image.h"

#include <cstring>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <half.h>

namespace limn::exr_image_test {
namespace {

using Imath::Box2i;
using Imath::V2i;

Result<ImageF> decode(const std::string& bytes, const MemoryBudget& memory = {}) {
    return decodeExr({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, memory);
}

/// The message of a file that is refused.
std::string problem(const std::string& bytes, const MemoryBudget& memory = {}) {
    const Result<ImageF> image = decode(bytes, memory);
    return image ? "" : image.error().message;
}

/// Values that halfs have, too.
ImageF picture(int width, int height) {
    ImageF image{std::uint32_t(width), std::uint32_t(height), {}};
    for (int i = 0; i < width * height; ++i)
        image.rgb.emplace_back(float(i % 7) * 0.25f, float(i % 100), -float(i % 3));
    return image;
}

Imf::Header headerOf(const Box2i& display, const Box2i& data, const std::string& names = "RGB",
                     Imf::PixelType type = Imf::FLOAT) {
    Imf::Header header(display, data);
    for (const char name : names)
        header.channels().insert(std::string(1, name), Imf::Channel(type));
    return header;
}

/// Writes the pixels of the data window. Other names than R, G and B get the three in turn.
template <class File, class WritePixels>
void writeTo(File& file, const Imf::Header& header, const ImageF& image, const WritePixels& write) {
    std::vector<Imath::half> halfs;
    for (const glm::vec3& rgb : image.rgb)
        for (int c = 0; c < 3; ++c)
            halfs.emplace_back(rgb[c]);
    Imf::FrameBuffer pixels;
    int next = 0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        const std::size_t known = std::string("RGB").find(c.name());
        const std::size_t i = known < 3 ? known : std::size_t(next++ % 3);
        const bool isHalf = c.channel().type == Imf::HALF;
        const void* first = isHalf ? static_cast<const void*>(&halfs[i]) : &image.rgb[0][int(i)];
        const std::size_t stride = 3 * (isHalf ? sizeof(Imath::half) : sizeof(float));
        pixels.insert(c.name(), Imf::Slice::Make(c.channel().type, first, header.dataWindow(),
                                                 stride, stride * image.width));
    }
    file.setFrameBuffer(pixels);
    write();
}

std::string written(const Imf::Header& header, const ImageF& image) {
    Imf::StdOSStream out;
    if (header.hasTileDescription()) {
        Imf::TiledOutputFile file(out, header, 0);
        writeTo(file, header, image, [&] {
            for (int level = 0; level < file.numLevels(); ++level)
                file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
        });
    } else {
        Imf::OutputFile file(out, header, 0);
        writeTo(file, header, image, [&] { file.writePixels(int(image.height)); });
    }
    return out.str();
}

Box2i window(int width, int height) {
    return {V2i(0, 0), V2i(width - 1, height - 1)};
}

TEST(ExrImage, EveryCompressionComesBack) {
    const ImageF image = picture(37, 45);
    ImageF smooth = image;
    for (std::size_t i = 0; i < smooth.rgb.size(); ++i)
        smooth.rgb[i] = glm::vec3(1.f, 2.f, 3.f) + float(i) / 1000.f;
    for (int compression = Imf::NO_COMPRESSION; compression <= Imf::DWAB_COMPRESSION; ++compression)
        for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT}) {
            Imf::Header header = headerOf(window(37, 45), window(37, 45), "BGR", type);
            header.compression() = Imf::Compression(compression);
            const bool isLossy = compression >= Imf::B44_COMPRESSION;
            const ImageF& expected = isLossy ? smooth : image;
            const Result<ImageF> again = decode(written(header, expected));
            ASSERT_TRUE(again) << again.error().message;
            for (std::size_t i = 0; i < expected.rgb.size(); ++i)
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(again->rgb[i][c], expected.rgb[i][c], isLossy ? 0.2 : 0)
                        << compression << " " << type;
        }
}

TEST(ExrImage, TilesAndTurnedLinesAreTaken) {
    const ImageF image = picture(37, 45);
    for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y}) {
        Imf::Header header = headerOf(window(37, 45), window(37, 45));
        header.lineOrder() = order;
        EXPECT_TRUE(*decode(written(header, image)) == image) << order;
        for (const Imf::LevelMode levels : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS}) {
            header.setTileDescription({16, 8, levels});
            const Result<ImageF> again = decode(written(header, image));
            ASSERT_TRUE(again) << again.error().message;
            EXPECT_TRUE(*again == image) << order << " " << levels;
        }
    }
}

/// What lies outside the data window is black, and what lies outside the display window is not
/// shown.
TEST(ExrImage, TheDisplayWindowIsThePicture) {
    const ImageF data = picture(6, 4);
    const Box2i display(V2i(10, 20), V2i(14, 26));
    for (const V2i& corner : {V2i(12, 21), V2i(8, 18), V2i(100, 20), V2i(-6, -4)}) {
        const Box2i dataWindow(corner, corner + V2i(5, 3));
        const Result<ImageF> image = decode(written(headerOf(display, dataWindow), data));
        ASSERT_TRUE(image) << image.error().message;
        ASSERT_EQ(image->width, 5u);
        ASSERT_EQ(image->height, 7u);
        for (int y = 0; y < 7; ++y)
            for (int x = 0; x < 5; ++x) {
                const V2i pixel = V2i(10 + x, 20 + y) - corner;
                const bool inside = pixel.x >= 0 && pixel.y >= 0 && pixel.x < 6 && pixel.y < 4;
                EXPECT_EQ(image->rgb[std::size_t(y * 5 + x)],
                          inside ? data.rgb[std::size_t(pixel.y * 6 + pixel.x)] : glm::vec3(0));
            }
    }
}

TEST(ExrImage, LuminanceAloneIsGrey) {
    const Result<ImageF> image =
        decode(written(headerOf(window(5, 5), window(5, 5), "Y"), picture(5, 5)));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->rgb[3], glm::vec3(0.75f));
}

/// ACES2065-1's white is that of Rec. 709, and its grey axis, too. Rec. 2020's red has the
/// components (1.6605, -0.1246, -0.0182) (ITU-R BT.2087-0).
TEST(ExrImage, OtherPrimariesBecomeRec709) {
    const ImageF image{3, 1, {{1, 1, 1}, {1, 0, 0}, {0.25f, 0.25f, 0.25f}}};
    Imf::Header header = headerOf(window(3, 1), window(3, 1));
    Imf::addChromaticities(header,
                           {{0.7347f, 0.2653f}, {0, 1}, {0.0001f, -0.077f}, {0.32168f, 0.33767f}});
    const Result<ImageF> aces = decode(written(header, image));
    ASSERT_TRUE(aces) << aces.error().message;
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(aces->rgb[0][c], 1, 1e-5);
        EXPECT_NEAR(aces->rgb[2][c], 0.25, 1e-5);
    }
    EXPECT_GT(aces->rgb[1].r, 2);
    EXPECT_LT(aces->rgb[1].g, 0);

    Imf::addChromaticities(
        header, {{0.708f, 0.292f}, {0.17f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.329f}});
    const Result<ImageF> wide = decode(written(header, image));
    ASSERT_TRUE(wide);
    EXPECT_NEAR(wide->rgb[1].r, 1.6605, 1e-4);
    EXPECT_NEAR(wide->rgb[1].g, -0.1246, 1e-4);
    EXPECT_NEAR(wide->rgb[1].b, -0.0182, 1e-4);

    Imf::addChromaticities(header, {});
    EXPECT_TRUE(*decode(written(header, image)) == image);
    Imf::addChromaticities(header, {{0, 0}, {0, 0}, {0, 0}, {0, 0}});
    EXPECT_EQ(problem(written(header, image)), "chromaticities: no colours can be made of them");
}

/// The first part with colours is the picture.
TEST(ExrImage, OfSeveralPartsTheFirstWithColoursIsTaken) {
    const ImageF image = picture(9, 5);
    std::vector<Imf::Header> headers = {headerOf(window(9, 5), window(9, 5), "Z"),
                                        headerOf(window(9, 5), window(9, 5), "RGBA")};
    headers[0].setName("depth");
    headers[1].setName("colour");
    for (Imf::Header& header : headers)
        header.setType(Imf::SCANLINEIMAGE);
    Imf::StdOSStream out;
    {
        Imf::MultiPartOutputFile file(out, headers.data(), 2, false, 0);
        for (int i = 0; i < 2; ++i) {
            Imf::OutputPart part(file, i);
            writeTo(part, headers[std::size_t(i)], image, [&] { part.writePixels(5); });
        }
    }
    const Result<ImageF> again = decode(out.str());
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_TRUE(*again == image);
}

TEST(ExrImage, WhatIsNoColourIsRefusedByName) {
    const auto refused = [](const std::string& names, Imf::PixelType type) {
        const ImageF image = picture(4, 4);
        Imf::Header header = headerOf(window(4, 4), window(4, 4), names, Imf::FLOAT);
        const std::string bytes = written(header, image);
        if (type == Imf::FLOAT)
            return problem(bytes);
        std::string integers = bytes; // the type of the first channel, B
        integers[integers.find("chlist") + 7 + 4 + 2] = 0;
        return problem(integers);
    };
    EXPECT_EQ(refused("ZA", Imf::FLOAT), "channels: there is no R, only A, Z");
    EXPECT_EQ(refused("RG", Imf::FLOAT), "channels: there is no B, only G, R");
    EXPECT_EQ(refused("RGB", Imf::UINT), "channels: B holds integers");

    Imf::Header header(window(4, 4), window(4, 4));
    for (const char* name : {"R", "G", "B"})
        header.channels().insert(name, Imf::Channel(Imf::FLOAT, 2, 2));
    Imf::StdOSStream out;
    Imf::OutputFile(out, header, 0);
    EXPECT_EQ(problem(out.str()), "channels: R is subsampled, which is not supported");
}

TEST(ExrImage, AFileThatEndsTooSoonIsRefused) {
    const std::string whole = *encodeExr(picture(19, 40));
    ASSERT_TRUE(decode(whole));
    for (std::size_t length = 0; length < whole.size(); length += 7)
        EXPECT_FALSE(decode(whole.substr(0, length))) << length;
}

TEST(ExrImage, FewBytesNeverBecomeManyPixels) {
    std::string bytes = *encodeExr(picture(19, 40));
    const std::string name("dataWindow\0box2i\0\x10\0\0\0", 21);
    const std::size_t corner = bytes.find(name) + name.size() + 8;
    const auto put = [&](std::int32_t x, std::int32_t y) {
        std::memcpy(&bytes[corner], &x, 4);
        std::memcpy(&bytes[corner + 4], &y, 4);
    };
    put(999999, 39);
    const std::string message = problem(bytes, {1U << 31});
    EXPECT_NE(message.find("dataWindow: 1000000 x 40 pixels cannot be packed"), std::string::npos)
        << message;
    EXPECT_NE(problem(bytes, {1 << 20}).find("the picture would need"), std::string::npos);
    put(1 << 29, 1 << 29);
    EXPECT_NE(problem(bytes), "");
    put(-1, 39);
    EXPECT_NE(problem(bytes), "");
}

} // namespace
} // namespace limn::exr_image_test
