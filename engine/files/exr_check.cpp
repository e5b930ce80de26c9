// SPDX-License-Identifier: MIT
#include "engine/files/exr_check.h"

#include <cstring>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace limn {

namespace {

/// Reads forward; once past the end it stays there and gives zeros.
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
    /// Up to the zero byte, which is taken too.
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

/// What the chunk table depends on.
struct ExrLayout {
    std::int32_t linesPerChunk = 0;
    std::int32_t minX = 0, minY = 0, maxX = -1, maxY = -1;
    std::int64_t channels = 0;
    std::int64_t chunkCount = 0; ///< 0: not stated
};

} // namespace

static constexpr std::int64_t kMaxTexels = std::int64_t(1) << 28; // 16k x 16k
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
    return {};
}

static Result<void> readWindow(ByteReader value, ExrLayout& layout) {
    layout.minX = value.number<std::int32_t>();
    layout.minY = value.number<std::int32_t>();
    layout.maxX = value.number<std::int32_t>();
    layout.maxY = value.number<std::int32_t>();
    const std::int64_t width = std::int64_t(layout.maxX) - layout.minX + 1;
    const std::int64_t height = std::int64_t(layout.maxY) - layout.minY + 1;
    if (!value.ok || width <= 0 || height <= 0 || width > kMaxTexels / height)
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

/// Each chunk is inside the file and starts a block of lines of its own.
static Result<void> checkChunks(const ExrLayout& layout, ByteReader table,
                                std::span<const std::uint8_t> file) {
    const std::int64_t height = std::int64_t(layout.maxY) - layout.minY + 1;
    const std::int64_t count = (height + layout.linesPerChunk - 1) / layout.linesPerChunk;
    if (layout.chunkCount != 0 && layout.chunkCount != count)
        return fail("chunkCount: does not fit the dataWindow");
    std::vector<bool> seen(static_cast<std::size_t>(count));
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
        seen[std::size_t(line / layout.linesPerChunk)] = true;
    }
    return {};
}

Result<void> checkExr(std::span<const std::uint8_t> file) {
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
    return checkChunks(*layout, reader, file);
}

} // namespace limn
