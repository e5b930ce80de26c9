// SPDX-License-Identifier: MIT
#include "engine/files/exr_check.h"

#include "engine/scene/decode_image.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace limn {

namespace {

/// Reads forward; at the end it stays there and returns zeros.
struct ByteReader {
    std::span<const std::uint8_t> rest;
    bool ok = true;

    std::span<const std::uint8_t> take(std::size_t count) {
        if (count > rest.size()) {
            ok = false;
            rest = {};
            return {};
        }
        const auto taken = rest.first(count);
        rest = rest.subspan(count);
        return taken;
    }
    template <class T>
    T number() { // EXR is little-endian, as are the machines that Limn runs on
        T value{};
        if (const auto bytes = take(sizeof(T)); ok)
            std::memcpy(&value, bytes.data(), sizeof(T));
        return value;
    }
    /// Reads a string up to its zero byte, which is consumed, too.
    std::string_view text() {
        const auto* end = static_cast<const std::uint8_t*>(
            rest.empty() ? nullptr : std::memchr(rest.data(), 0, rest.size()));
        if (!end) {
            ok = false;
            return {};
        }
        const auto bytes = take(std::size_t(end - rest.data()) + 1);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size() - 1};
    }
};

/// Properties that determine the chunk table.
struct ExrLayout {
    std::int32_t linesPerChunk = 0;
    bool isPiz = false;
    std::int32_t minX = 0, minY = 0, maxX = -1, maxY = -1;
    std::int64_t channels = 0;
    std::int64_t texelBytes = 0; ///< of all channels
    std::int64_t chunkCount = 0; ///< 0: not stated
};

} // namespace

static constexpr std::size_t kMaxName = 255;
static constexpr std::int64_t kMaxChannels = 64;

static Result<void> readChannels(ByteReader value, ExrLayout& layout) {
    for (std::string_view name = value.text(); !name.empty(); name = value.text()) {
        const auto type = value.number<std::int32_t>();
        value.take(4);
        const auto samplingX = value.number<std::int32_t>();
        const auto samplingY = value.number<std::int32_t>();
        if (!value.ok || name.size() > kMaxName || type < 0 || type > 2)
            return fail("channels: malformed");
        if (samplingX != 1 || samplingY != 1)
            return fail("channels: subsampled channels are not supported");
        layout.texelBytes += type == 1 ? 2 : 4; // half; float or integer
        if (++layout.channels > kMaxChannels)
            return fail("channels: too many");
    }
    if (!value.ok || layout.channels == 0)
        return fail("channels: malformed");
    return {};
}

static Result<void> readCompression(ByteReader value, ExrLayout& layout) {
    static constexpr std::int32_t kLines[5] = {1, 1, 1, 16, 32}; // none, RLE, ZIPS, ZIP, PIZ
    const auto compression = value.number<std::uint8_t>();
    if (!value.ok || compression >= std::size(kLines))
        return fail("compression: not one of none, RLE, ZIPS, ZIP, PIZ");
    layout.linesPerChunk = kLines[compression];
    layout.isPiz = compression == 4;
    return {};
}

static Result<void> readWindow(ByteReader value, ExrLayout& layout) {
    layout.minX = value.number<std::int32_t>();
    layout.minY = value.number<std::int32_t>();
    layout.maxX = value.number<std::int32_t>();
    layout.maxY = value.number<std::int32_t>();
    const std::int64_t width = std::int64_t(layout.maxX) - layout.minX + 1;
    const std::int64_t height = std::int64_t(layout.maxY) - layout.minY + 1;
    if (!value.ok || width <= 0 || height <= 0 || width > std::int64_t(kMaxTexels) / height)
        return fail(fmt::format("dataWindow: {} x {} texels", width, height));
    constexpr std::int32_t kFar = 1 << 20; // beyond it tinyexr takes line numbers for damage
    if (layout.minX < -kFar || layout.minY < -kFar || layout.maxX > kFar || layout.maxY > kFar)
        return fail("dataWindow: too far from the origin");
    return {};
}

static Result<ExrLayout> readAttributes(ByteReader& file) {
    ExrLayout layout;
    for (std::string_view name = file.text(); !name.empty(); name = file.text()) {
        const std::string_view type = file.text();
        const auto size = file.number<std::int32_t>();
        if (!file.ok || size < 0 || name.size() > kMaxName || type.size() > kMaxName)
            return fail("header: malformed attribute");
        const ByteReader value{file.take(std::size_t(size))};
        if (!file.ok)
            return fail(fmt::format("{}: exceeds the file", name));
        Result<void> read;
        if (name == "channels")
            read = layout.channels ? Result<void>(fail("channels: there twice"))
                                   : readChannels(value, layout);
        else if (name == "compression")
            read = readCompression(value, layout);
        else if (name == "dataWindow")
            read = readWindow(value, layout);
        else if (name == "chunkCount")
            layout.chunkCount = ByteReader(value).number<std::int32_t>();
        else if (name == "tiles")
            read = fail("tiles: tiled EXR is not supported");
        if (!read)
            return tl::make_unexpected(read.error());
    }
    if (!file.ok)
        return fail("header: truncated");
    if (layout.linesPerChunk == 0 || layout.channels == 0 || layout.maxX < layout.minX)
        return fail("header: compression, channels or dataWindow is missing");
    return layout;
}

/// Upper limit of EXR's compression ratio: deflate packs 1032 bytes into one.
constexpr std::int64_t kMaxPerByte = 1100;

/// Checks the bitmap of values and the Huffman table of a PIZ chunk, after OpenEXR's
/// ImfPizCompressor.cpp and ImfHuf.cpp.
static Result<void> checkPiz(ByteReader chunk) {
    constexpr std::uint32_t kBitmap = 8192, kCodes = 65537;
    const auto minNonZero = chunk.number<std::uint16_t>(),
               maxNonZero = chunk.number<std::uint16_t>();
    if (maxNonZero >= kBitmap)
        return fail("values: out of range");
    if (minNonZero <= maxNonZero)
        chunk.take(std::size_t(maxNonZero - minNonZero) + 1);
    const auto length = chunk.number<std::int32_t>();
    if (!chunk.ok || length < 0 || std::size_t(length) > chunk.rest.size())
        return fail("codes: exceed the chunk");
    if (length == 0)
        return {};
    const auto first = chunk.number<std::uint32_t>(), last = chunk.number<std::uint32_t>();
    chunk.take(4); // the table's length, which nobody reads
    const auto bits = chunk.number<std::int32_t>();
    chunk.take(4);
    constexpr std::int32_t kHeader = 20;
    if (!chunk.ok || length < kHeader || first >= kCodes || last >= kCodes || bits < 0 ||
        bits > 8LL * (length - kHeader))
        return fail("codes: malformed");
    return {};
}

/// Checks that each chunk lies in the file, shares no bytes, and starts its own block of lines.
static Result<void> checkChunks(const ExrLayout& layout, ByteReader table,
                                std::span<const std::uint8_t> file) {
    const std::int64_t height = std::int64_t(layout.maxY) - layout.minY + 1;
    const std::int64_t count = (height + layout.linesPerChunk - 1) / layout.linesPerChunk;
    if (layout.chunkCount != 0 && layout.chunkCount != count)
        return fail("chunkCount: does not fit the dataWindow");
    const std::int64_t width = std::int64_t(layout.maxX) - layout.minX + 1;
    if (std::uint64_t(count) > table.rest.size() / sizeof(std::uint64_t))
        return fail("chunks: their table exceeds the file");
    std::vector<bool> seen(static_cast<std::size_t>(count));
    std::size_t sum = 0;
    for (std::int64_t i = 0; i < count; ++i) {
        const auto offset = table.number<std::uint64_t>();
        if (!table.ok || offset > file.size())
            return fail(fmt::format("chunk {}: lies outside the file", i));
        ByteReader chunk{file.subspan(std::size_t(offset))};
        const std::int64_t line = std::int64_t(chunk.number<std::int32_t>()) - layout.minY;
        const auto size = chunk.number<std::int32_t>();
        if (!chunk.ok || size <= 0 || std::size_t(size) > chunk.rest.size())
            return fail(fmt::format("chunk {}: lies outside the file", i));
        if (line < 0 || line >= height || line % layout.linesPerChunk != 0 ||
            seen[std::size_t(line / layout.linesPerChunk)])
            return fail(fmt::format("chunk {}: wrong line", i));
        const std::int64_t lines = std::min<std::int64_t>(layout.linesPerChunk, height - line);
        const std::int64_t plain = lines * width * layout.texelBytes;
        if (plain / kMaxPerByte > size)
            return fail(fmt::format("chunk {}: too short for its lines", i));
        if (layout.isPiz && size != plain) // of that size it is not packed
            if (const Result<void> valid = checkPiz({chunk.rest.first(std::size_t(size))}); !valid)
                return fail(fmt::format("chunk {}: {}", i, valid.error().message));
        sum += std::size_t(size); // of chunks inside the file, no more of them than it has bytes
        if (sum > file.size())
            return fail(fmt::format("chunk {}: shares bytes with others", i));
        seen[std::size_t(line / layout.linesPerChunk)] = true;
    }
    return {};
}

Result<ExrSize> checkExr(std::span<const std::uint8_t> file) {
    ByteReader reader{file};
    const auto magic = reader.number<std::uint32_t>();
    const auto version = reader.number<std::uint32_t>();
    if (!reader.ok || magic != 0x01312f76)
        return fail("no EXR file");
    if ((version & 0xff) != 2)
        return fail(fmt::format("EXR version {} is not supported", version & 0xff));
    if (version & ~0x4ffu) // all flags but long names
        return fail("tiled, deep and multipart EXR are not supported");
    const Result<ExrLayout> layout = readAttributes(reader);
    if (!layout)
        return tl::make_unexpected(layout.error());
    if (const Result<void> chunks = checkChunks(*layout, reader, file); !chunks)
        return tl::make_unexpected(chunks.error());
    return ExrSize{std::uint32_t(layout->maxX - layout->minX + 1),
                   std::uint32_t(layout->maxY - layout->minY + 1), std::uint32_t(layout->channels)};
}

} // namespace limn
