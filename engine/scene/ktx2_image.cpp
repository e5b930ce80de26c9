// SPDX-License-Identifier: MIT
#include "engine/scene/ktx2_image.h"

#include "engine/scene/ktx2_header.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/format.h>
#include <squish.h>
#include <zstd.h>

namespace limn {

namespace {

using Bytes = std::span<const std::uint8_t>;

template <class T>
T numberAt(Bytes bytes, std::size_t offset) { // little-endian, as all machines that this runs on
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

/// A format that is read.
struct Format {
    std::uint32_t vulkan; ///< without sRGB
    std::uint32_t vulkanSrgb;
    std::uint32_t unit;      ///< bytes of a texel, or of a block of 4 x 4
    int squish;              ///< 0: texels
    std::array<int, 4> from; ///< the byte that red, green, blue and alpha have; -1: 255
};
constexpr std::array<Format, 9> kFormats = {{{9, 15, 1, 0, {0, 0, 0, -1}},  // R8
                                             {23, 29, 3, 0, {0, 1, 2, -1}}, // R8G8B8
                                             {30, 36, 3, 0, {2, 1, 0, -1}}, // B8G8R8
                                             {37, 43, 4, 0, {0, 1, 2, 3}},  // R8G8B8A8
                                             {44, 50, 4, 0, {2, 1, 0, 3}},  // B8G8R8A8
                                             {131, 132, 8, squish::kDxt1, {0, 1, 2, -1}},
                                             {133, 134, 8, squish::kDxt1, {0, 1, 2, 3}},
                                             {135, 136, 16, squish::kDxt3, {0, 1, 2, 3}},
                                             {137, 138, 16, squish::kDxt5, {0, 1, 2, 3}}}};

const Format* formatOf(std::uint32_t vulkan) {
    const auto* found = std::ranges::find_if(
        kFormats, [&](const Format& f) { return f.vulkan == vulkan || f.vulkanSrgb == vulkan; });
    return found == kFormats.end() ? nullptr : found;
}

std::string nameOfFormat(std::uint32_t vulkan) {
    const auto within = [&](std::uint32_t first, std::uint32_t last) {
        return vulkan >= first && vulkan <= last;
    };
    if (within(139, 146))
        return fmt::format("BC{}", 4 + (vulkan - 139) / 2);
    if (within(147, 156))
        return "ETC2";
    if (within(157, 184))
        return "ASTC";
    return fmt::format("Vulkan's format {}", vulkan);
}

std::uint64_t bytesOf(const Format& format, ImageSize size) {
    const std::uint64_t side = format.squish ? 4 : 1;
    return (size.width + side - 1) / side * ((size.height + side - 1) / side) * format.unit;
}

tl::unexpected<Error> notRead(const std::string& what) {
    return fail(fmt::format("is KTX2 of {}, which is not read", what));
}

} // namespace

bool isKtx2(Bytes bytes) {
    return bytes.size() >= kKtx2Identifier.size() &&
           std::equal(kKtx2Identifier.begin(), kKtx2Identifier.end(), bytes.begin());
}

Result<Ktx2Picture> readKtx2Picture(Bytes bytes) {
    if (bytes.size() < kKtx2Header)
        return fail("is damaged");
    const auto word = [&](Ktx2Word w) {
        return numberAt<std::uint32_t>(bytes, kKtx2Identifier.size() + 4 * std::size_t(w));
    };
    constexpr std::uint32_t kNone = 0, kBasisLz = 1;
    const std::uint32_t packing = word(kKtx2Supercompression);
    if (packing == kBasisLz)
        return notRead("Basis Universal (ETC1S)");
    if (word(kKtx2VkFormat) == 0)
        return notRead("Basis Universal (UASTC)");
    if (packing != kNone && packing != kKtx2Zstd)
        return notRead(fmt::format("supercompression {}", packing));
    const Format* format = formatOf(word(kKtx2VkFormat));
    if (!format)
        return notRead(nameOfFormat(word(kKtx2VkFormat)));
    if (word(kKtx2Depth) != 0 || word(kKtx2Layers) > 1 || word(kKtx2Faces) != 1)
        return notRead("a volume, an array or a cube");
    Ktx2Picture picture{.size = {word(kKtx2Width), word(kKtx2Height)},
                        .format = word(kKtx2VkFormat),
                        .isPacked = packing == kKtx2Zstd,
                        .stored = {},
                        .bytes = numberAt<std::uint64_t>(bytes, kKtx2LevelIndex + 16)};
    const auto offset = numberAt<std::uint64_t>(bytes, kKtx2LevelIndex),
               stored = numberAt<std::uint64_t>(bytes, kKtx2LevelIndex + 8);
    if (picture.size.width == 0 || picture.size.height == 0 || offset > bytes.size() ||
        stored > bytes.size() - offset || picture.bytes != bytesOf(*format, picture.size) ||
        (!picture.isPacked && stored != picture.bytes))
        return fail("is damaged");
    picture.stored = bytes.subspan(offset, stored);
    return picture;
}

bool decodeKtx2Picture(const Ktx2Picture& picture, std::vector<std::uint8_t>& rgba) {
    const Format& format = *formatOf(picture.format);
    Bytes texels = picture.stored;
    std::vector<std::uint8_t> unpacked;
    if (picture.isPacked) {
        // Before anything is allocated: the frame says how much it holds, and the stream needs no
        // more.
        const unsigned long long size = ZSTD_getFrameContentSize(texels.data(), texels.size());
        if (size != picture.bytes && size != ZSTD_CONTENTSIZE_UNKNOWN)
            return false;
        unpacked.resize(picture.bytes);
        if (ZSTD_decompress(unpacked.data(), unpacked.size(), texels.data(), texels.size()) !=
            picture.bytes)
            return false;
        texels = unpacked;
    }
    if (format.squish) {
        squish::DecompressImage(rgba.data(), int(picture.size.width), int(picture.size.height),
                                texels.data(), format.squish);
        for (std::size_t i = 3; format.from[3] < 0 && i < rgba.size(); i += 4)
            rgba[i] = 255;
        return true;
    }
    for (std::size_t i = 0; i < rgba.size() / 4; ++i)
        for (std::size_t c = 0; c < 4; ++c)
            rgba[4 * i + c] =
                format.from[c] < 0 ? 255 : texels[i * format.unit + std::size_t(format.from[c])];
    return true;
}

} // namespace limn
