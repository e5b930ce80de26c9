// SPDX-License-Identifier: MIT
#include "engine/files/ktx2.h"

#include "engine/core/hash.h"

#include <cmath>
#include <limits>
#include <random>

#include <glm/common.hpp>
#include <gtest/gtest.h>

namespace limn::ktx2_test {
namespace {

std::span<const std::uint8_t> bytesOf(const std::string& file) {
    return {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()};
}

std::string encoded(const Ktx2Shape& shape, const std::vector<glm::vec4>& texels) {
    const Result<std::string> file = encodeKtx2(shape, texels);
    EXPECT_TRUE(file) << file.error().message;
    return *file;
}

std::vector<glm::vec4> decoded(const std::string& file) {
    const Result<Ktx2Texture> texture = decodeKtx2(bytesOf(file));
    EXPECT_TRUE(texture) << texture.error().message;
    return texture ? texture->texels : std::vector<glm::vec4>();
}

std::vector<glm::vec4> randomTexels(std::size_t count, float smallest) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> exponent(std::log2(smallest), 15), sign(-1, 1);
    std::vector<glm::vec4> texels(count);
    for (glm::vec4& t : texels)
        for (int c = 0; c < 4; ++c)
            t[c] = std::copysign(std::exp2(exponent(random)), sign(random));
    return texels;
}

void put(std::string& out, std::initializer_list<std::uint32_t> words) {
    for (const std::uint32_t w : words)
        for (int shift = 0; shift < 32; shift += 8)
            out += char(w >> shift);
}

/// The file of one texel (1, 2, -0.5, 1) in half floats, written down from the two specifications.
std::string tinyFile() {
    std::string f("\xabKTX 20\xbb\r\n\x1a\n", 12);
    // vkFormat, typeSize, width, height, depth, layers, faces, levels, supercompression
    put(f, {97, 2, 1, 1, 0, 0, 1, 1, 0});
    // Descriptor at 104, 92 bytes; key/value data at 196: 4 + 18 + 2 and 4 + 15 + 1 bytes.
    put(f, {104, 92, 196, 44, 0, 0, 0, 0});
    put(f, {240, 0, 8, 0, 8, 0}); // the level: 240 is a multiple of 8
    put(f, {92, 0, 2 | 88 << 16, 1 | 1 << 8 | 1 << 16, 0, 8, 0});
    std::uint32_t offset = 0;
    for (const std::uint32_t channel : {0, 1, 2, 15}) {
        put(f, {offset | 15 << 16 | (channel | 0xc0) << 24, 0, 0xbf800000, 0x3f800000});
        offset += 16;
    }
    put(f, {18});
    f += std::string("KTXorientation\0rd\0\0\0", 20);
    put(f, {15});
    f += std::string("KTXwriter\0limn\0\0", 16);
    f += std::string("\x00\x3c\x00\x40\x00\xb8\x00\x3c", 8);
    return f;
}

} // namespace

TEST(Ktx2, ATinyFileIsByteForByteWhatTheSpecificationsSay) {
    const std::string file = encoded({.format = Ktx2Format::Rgba16f}, {{1, 2, -0.5f, 1}});
    EXPECT_EQ(file, tinyFile());
    EXPECT_EQ(decoded(tinyFile()), (std::vector<glm::vec4>{{1, 2, -0.5f, 1}}));
}

TEST(Ktx2, ColoursWithoutAlphaGetAnAlphaOfOne) {
    const std::vector<glm::vec3> texels = {{1, 2, -0.5f}};
    EXPECT_EQ(*encodeKtx2({.format = Ktx2Format::Rgba16f}, texels), tinyFile());
}

TEST(Ktx2, PowersOfTwoAreExact) {
    std::vector<glm::vec4> texels;
    for (int e = -14; e <= 15; ++e)
        texels.emplace_back(glm::vec3(std::ldexp(1.f, e)), 1);
    const auto count = std::uint32_t(texels.size());
    for (const Ktx2Format format : {Ktx2Format::Rgba16f, Ktx2Format::Rgba32f, Ktx2Format::Rgb9e5})
        EXPECT_EQ(decoded(encoded({.format = format, .width = count}, texels)), texels);
}

TEST(Ktx2, EveryShapeComesBackInOrderWithAndWithoutZstandard) {
    for (const bool zstd : {false, true})
        for (const Ktx2Shape& shape :
             {Ktx2Shape{.width = 5, .height = 3}, Ktx2Shape{.width = 5, .height = 3, .layers = 1},
              Ktx2Shape{.width = 5, .height = 3, .layers = 4},
              Ktx2Shape{.width = 1, .height = 7, .depth = 6}})
            for (const Ktx2Format format :
                 {Ktx2Format::Rgba16f, Ktx2Format::Rgba32f, Ktx2Format::Rgb9e5}) {
                Ktx2Shape s = shape;
                s.format = format;
                s.zstd = zstd;
                std::vector<glm::vec4> texels(s.texels());
                for (std::size_t i = 0; i < texels.size(); ++i)
                    texels[i] = {float(i), 1, 0, 1};
                const std::string file = encoded(s, texels);
                const Result<Ktx2Texture> back = decodeKtx2(bytesOf(file));
                ASSERT_TRUE(back) << back.error().message;
                EXPECT_EQ(back->shape, s);
                EXPECT_EQ(back->texels, texels);
                EXPECT_EQ(file, encoded(s, texels)) << "two writes differ";
            }
}

TEST(Ktx2, HalfFloatsAreWithinHalfAStep) {
    const std::vector<glm::vec4> texels = randomTexels(4096, 0x1p-14f);
    const std::vector<glm::vec4> back = decoded(encoded({.width = 64, .height = 64}, texels));
    float worst = 0;
    for (std::size_t i = 0; i < texels.size(); ++i)
        for (int c = 0; c < 4; ++c)
            worst = std::max(worst, std::abs(back[i][c] / texels[i][c] - 1));
    EXPECT_LE(worst, 0x1p-11f);
    EXPECT_GT(worst, 0x1p-12f);
}

TEST(Ktx2, SharedExponentsAreWithinHalfAStepOfTheLargestComponent) {
    std::vector<glm::vec4> texels = randomTexels(4096, 0x1p-14f);
    for (glm::vec4& t : texels)
        t = glm::abs(t);
    const std::vector<glm::vec4> back =
        decoded(encoded({.format = Ktx2Format::Rgb9e5, .width = 64, .height = 64}, texels));
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const float most = std::max({texels[i].x, texels[i].y, texels[i].z});
        for (int c = 0; c < 3; ++c)
            EXPECT_LE(std::abs(back[i][c] - texels[i][c]), most * 0x1p-9f);
    }
}

TEST(Ktx2, WhatDoesNotFitIsClampedAndNotANumberIsZero) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::vector<glm::vec4> texels = {{1e9f, -1e9f, std::nanf(""), kInfinity}};
    EXPECT_EQ(decoded(encoded({.format = Ktx2Format::Rgba16f}, texels)),
              (std::vector<glm::vec4>{{65504, -65504, 0, 65504}}));
    EXPECT_EQ(decoded(encoded({.format = Ktx2Format::Rgb9e5}, texels)),
              (std::vector<glm::vec4>{{65408, 0, 0, 1}}));
    EXPECT_EQ(decoded(encoded({.format = Ktx2Format::Rgba32f}, texels))[0].w,
              std::numeric_limits<float>::max());
}

// Sides that four does not divide have blocks of which a part lies beyond the edge.
TEST(Ktx2, BlocksComeBackInOrder) {
    for (const Ktx2Format format : {Ktx2Format::Bc6hUnsigned, Ktx2Format::Bc6hSigned})
        for (const bool zstd : {false, true})
            for (const Ktx2Shape shape :
                 {Ktx2Shape{format, 1, 1, 0, 0, zstd}, Ktx2Shape{format, 9, 6, 0, 0, zstd},
                  Ktx2Shape{format, 8, 5, 3, 0, zstd}, Ktx2Shape{format, 3, 13, 0, 2, zstd}}) {
                const float sign = format == Ktx2Format::Bc6hSigned ? -1 : 1;
                std::vector<glm::vec4> texels(shape.texels());
                for (std::size_t i = 0; i < texels.size(); ++i) {
                    const std::size_t x = i % shape.width, row = i / shape.width;
                    const std::size_t y = row % shape.height, image = row / shape.height;
                    // Even in each block, so that it is exact.
                    texels[i] =
                        glm::vec4(sign * float(x / 4 + 1), float(y / 4 + 1), float(image + 1), 1);
                }
                const std::string file = encoded(shape, texels);
                EXPECT_EQ(decoded(file), texels) << shape.width << " " << zstd;
                EXPECT_EQ(*readKtx2Shape(bytesOf(file)), shape);
            }
}

TEST(Ktx2, ImpossibleTexturesAreRefused) {
    const std::vector<glm::vec4> none;
    EXPECT_FALSE(encodeKtx2({.width = 0}, none));
    const std::vector<glm::vec4> four(4);
    EXPECT_FALSE(encodeKtx2({.layers = 2, .depth = 4}, four));
}

TEST(Ktx2, ReadingRefusesTexturesBeyondTheMemory) {
    const std::vector<glm::vec4> texels(4096);
    const std::string file = encoded({.width = 64, .height = 64, .zstd = true}, texels);
    EXPECT_FALSE(decodeKtx2(bytesOf(file), MemoryBudget{4096 * 16}));
    EXPECT_TRUE(decodeKtx2(bytesOf(file), MemoryBudget{4096 * (16 + 8)}));
}

TEST(Ktx2, EveryTruncationIsRefused) {
    for (const bool zstd : {false, true}) {
        const std::string file =
            encoded({.width = 4, .height = 4, .zstd = zstd}, randomTexels(16, 1));
        for (std::size_t size = 0; size < file.size(); ++size)
            EXPECT_FALSE(decodeKtx2(bytesOf(file.substr(0, size)))) << size;
    }
}

TEST(Ktx2, EveryFlippedByteOfTheHeadIsRefused) {
    for (const bool zstd : {false, true}) {
        const Ktx2Shape shape{.width = 4, .height = 4, .layers = 1, .zstd = zstd};
        const std::string file = encoded(shape, randomTexels(16, 1));
        int accepted = 0;
        for (std::size_t at = 0; at < file.size(); ++at)
            for (const int mask : {1, 0x80, 0xff}) {
                std::string damaged = file;
                damaged[at] = char(damaged[at] ^ mask);
                if (const auto texture = decodeKtx2(bytesOf(damaged), MemoryBudget{1 << 20})) {
                    EXPECT_EQ(texture->texels.size(), texture->shape.texels());
                    if (at < 196 && at != 32) // key/value data; an array of one becomes none
                        ++accepted;
                }
            }
        EXPECT_EQ(accepted, 0);
    }
}

} // namespace limn::ktx2_test
