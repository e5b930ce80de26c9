// SPDX-License-Identifier: MIT
#include "engine/files/ktx2.h"

#include "engine/files/bc6h.h"
#include "engine/files/ktx2_layout.h"
#include "engine/math/packing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string_view>

#include <fmt/format.h>
#include <zstd.h>

namespace limn {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint32_t kMaxSide = 1 << 16; ///< of a texture that is read [texels]

std::uint32_t wordAt(Bytes file, std::size_t offset) {
    return std::uint32_t(file[offset]) | std::uint32_t(file[offset + 1]) << 8 |
           std::uint32_t(file[offset + 2]) << 16 | std::uint32_t(file[offset + 3]) << 24;
}

std::uint64_t longAt(Bytes file, std::size_t offset) {
    return wordAt(file, offset) | std::uint64_t(wordAt(file, offset + 4)) << 32;
}

std::uint32_t headerWord(Bytes file, Ktx2Word word) {
    return wordAt(file, kKtx2Identifier.size() + 4 * std::size_t(word));
}

tl::unexpected<Error> malformed(const char* what) {
    return fail(fmt::format("malformed KTX2: {}", what));
}

bool within(Bytes file, std::uint64_t offset, std::uint64_t bytes) {
    return offset <= file.size() && bytes <= file.size() - offset;
}

/// The level's bytes in the file, and once unpacked.
struct Level {
    std::uint64_t offset, stored, bytes;
};

Level levelOf(Bytes file) {
    return {longAt(file, kKtx2LevelIndex), longAt(file, kKtx2LevelIndex + 8),
            longAt(file, kKtx2LevelIndex + 16)};
}

Result<void> checkDescriptor(Bytes file, const Ktx2Shape& shape) {
    const std::uint64_t offset = headerWord(file, kKtx2DfdOffset);
    const std::uint64_t size = headerWord(file, kKtx2DfdBytes);
    if (offset < kKtx2Header || offset % 4 != 0 || !within(file, offset, size))
        return malformed("data format descriptor out of the file");
    const std::string_view found(reinterpret_cast<const char*>(file.data() + offset), size);
    // A later revision of the specification lets compressed texels keep their size.
    if (found != ktx2Descriptor(shape.format, true) &&
        !(shape.zstd && found == ktx2Descriptor(shape.format, false)))
        return malformed("data format descriptor differs from the format");
    return {};
}

Result<void> checkKeys(Bytes file, const Ktx2Shape& shape) {
    const std::uint64_t offset = headerWord(file, kKtx2KvdOffset);
    const std::uint64_t size = headerWord(file, kKtx2KvdBytes);
    if (size == 0)
        return {};
    if (offset < kKtx2Header || offset % 4 != 0 || !within(file, offset, size))
        return malformed("key/value data out of the file");
    Bytes rest = file.subspan(offset, size);
    while (!rest.empty()) {
        if (rest.size() < 4)
            return malformed("key/value data");
        const std::uint64_t length = wordAt(rest, 0), padded = (length + 3) / 4 * 4;
        if (length > rest.size() - 4 || padded > rest.size() - 4)
            return malformed("key/value data");
        const std::string_view pair(reinterpret_cast<const char*>(rest.data() + 4), length);
        const std::size_t end = pair.find('\0');
        if (end == std::string_view::npos || end == 0)
            return malformed("key without end");
        const std::string_view expected = shape.depth > 0 ? "rdi" : "rd";
        if (pair.substr(0, end) == "KTXorientation" &&
            pair.substr(end + 1) != std::string_view(expected.data(), expected.size() + 1))
            return fail("KTX2: only textures from the top row down are read");
        rest = rest.subspan(4 + padded);
    }
    return {};
}

Result<void> checkLevel(Bytes file, const Ktx2Shape& shape) {
    const Level level = levelOf(file);
    if (level.bytes != shape.bytes())
        return malformed("size of the texels");
    const std::uint64_t head = std::max(
        {std::uint64_t(kKtx2Header),
         std::uint64_t(headerWord(file, kKtx2DfdOffset)) + headerWord(file, kKtx2DfdBytes),
         std::uint64_t(headerWord(file, kKtx2KvdOffset)) + headerWord(file, kKtx2KvdBytes)});
    if (level.offset < head || !within(file, level.offset, level.stored))
        return malformed("texels out of the file");
    if (!shape.zstd &&
        (level.stored != level.bytes || level.offset % ktx2BlockBytes(shape.format) != 0))
        return malformed("place of the texels");
    return {};
}

Result<Ktx2Shape> shapeOf(Bytes file) {
    if (file.size() < kKtx2Header)
        return fail("truncated KTX2");
    if (!std::equal(kKtx2Identifier.begin(), kKtx2Identifier.end(), file.begin()))
        return fail("not a KTX2 file");
    const auto word = [&](Ktx2Word w) { return headerWord(file, w); };
    Ktx2Shape shape;
    switch (word(kKtx2VkFormat)) {
    case std::uint32_t(Ktx2Format::Rgba16f):
    case std::uint32_t(Ktx2Format::Rgba32f):
    case std::uint32_t(Ktx2Format::Rgb9e5):
    case std::uint32_t(Ktx2Format::Bc6hUnsigned):
    case std::uint32_t(Ktx2Format::Bc6hSigned):
        shape.format = Ktx2Format(word(kKtx2VkFormat));
        break;
    default:
        return fail(fmt::format("KTX2: format {} is not read", word(kKtx2VkFormat)));
    }
    shape.width = word(kKtx2Width);
    shape.height = word(kKtx2Height);
    shape.depth = word(kKtx2Depth);
    shape.layers = word(kKtx2Layers);
    if (word(kKtx2TypeSize) != ktx2TypeSize(shape.format))
        return malformed("type size");
    if (shape.width == 0 || shape.height == 0 ||
        std::max({shape.width, shape.height, shape.depth, shape.layers}) > kMaxSide)
        return malformed("width, height, depth or layers");
    if ((shape.depth > 0 && shape.layers > 0) || word(kKtx2Faces) != 1 || word(kKtx2Levels) != 1)
        return fail("KTX2: only 2D, array and 3D textures of one level are read");
    if (word(kKtx2Supercompression) != 0 && word(kKtx2Supercompression) != kKtx2Zstd)
        return fail("KTX2: of all supercompressions only Zstandard is read");
    shape.zstd = word(kKtx2Supercompression) == kKtx2Zstd;
    if (longAt(file, kKtx2LevelIndex - 16) != 0 || longAt(file, kKtx2LevelIndex - 8) != 0)
        return malformed("global supercompression data");
    return shape;
}

float finiteHalf(Bytes texels, std::size_t offset, bool& finite) {
    const auto half = std::uint16_t(texels[offset] | texels[offset + 1] << 8);
    finite = finite && (half & 0x7c00) != 0x7c00;
    return halfToFloat(half);
}

glm::vec4 texelAt(Bytes texels, Ktx2Format format, std::size_t i, bool& finite) {
    const std::size_t offset = i * ktx2BlockBytes(format);
    if (format == Ktx2Format::Rgb9e5)
        return {unpackRgb9e5(wordAt(texels, offset)), 1};
    glm::vec4 texel;
    for (std::size_t c = 0; c < 4; ++c) {
        if (format == Ktx2Format::Rgba16f) {
            texel[int(c)] = finiteHalf(texels, offset + 2 * c, finite);
        } else {
            texel[int(c)] = std::bit_cast<float>(wordAt(texels, offset + 4 * c));
            finite = finite && std::isfinite(texel[int(c)]);
        }
    }
    return texel;
}

void readBlocks(Bytes bytes, Ktx2Texture& texture) {
    const Ktx2Shape& shape = texture.shape;
    const Bc6hSign sign = bc6hSignOf(shape.format);
    const std::size_t columns = (shape.width + 3) / 4, rows = (shape.height + 3) / 4;
    Bc6hBlock block;
    for (std::size_t b = 0; b < bytes.size() / block.size(); ++b) {
        std::ranges::copy(bytes.subspan(b * block.size(), block.size()), block.begin());
        const Bc6hTexels texels = decodeBc6h(block, sign);
        const std::size_t row = b / columns, layer = row / rows;
        for (std::size_t i = 0; i < texels.size(); ++i) {
            const std::size_t x = 4 * (b % columns) + i % 4, y = 4 * (row % rows) + i / 4;
            if (x < shape.width && y < shape.height)
                texture.texels[(layer * shape.height + y) * shape.width + x] =
                    glm::vec4(texels[i], 1);
        }
    }
}

} // namespace

Result<Ktx2Shape> readKtx2Shape(Bytes file) {
    const Result<Ktx2Shape> shape = shapeOf(file);
    if (!shape)
        return shape;
    for (const auto check : {checkDescriptor, checkKeys, checkLevel})
        if (const Result<void> ok = check(file, *shape); !ok)
            return tl::make_unexpected(ok.error());
    return shape;
}

Result<Ktx2Texture> decodeKtx2(Bytes file, const MemoryBudget& memory) {
    const Result<Ktx2Shape> shape = readKtx2Shape(file);
    if (!shape)
        return tl::make_unexpected(shape.error());
    const Level level = levelOf(file);
    const std::uint64_t needed =
        shape->texels() * sizeof(glm::vec4) + (shape->zstd ? level.bytes : 0);
    if (const Result<void> ok = memory.allow("texture", needed); !ok)
        return tl::make_unexpected(ok.error());
    Bytes texels = file.subspan(level.offset, level.stored);
    std::vector<std::uint8_t> unpacked;
    if (shape->zstd) {
        unpacked.resize(level.bytes);
        const std::size_t size =
            ZSTD_decompress(unpacked.data(), unpacked.size(), texels.data(), texels.size());
        if (ZSTD_isError(size) || size != level.bytes)
            return malformed("compressed texels");
        texels = unpacked;
    }
    Ktx2Texture texture{*shape, std::vector<glm::vec4>(shape->texels())};
    if (ktx2BlockSide(shape->format) > 1) {
        readBlocks(texels, texture); // which are finite
        return texture;
    }
    bool finite = true;
    for (std::size_t i = 0; i < texture.texels.size(); ++i)
        texture.texels[i] = texelAt(texels, shape->format, i, finite);
    if (!finite)
        return fail("KTX2: a texel is infinite or not a number");
    return texture;
}

} // namespace limn
