// SPDX-License-Identifier: MIT
#include "engine/stages/chunk_file.h"

#include "engine/core/hash.h"
#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"

#include <algorithm>
#include <cstring>

#include <zstd.h>

namespace limn {

static constexpr std::size_t kMark = 8, kHeader = kMark + 8, kChunkHeader = 8 + 3 * 8;

ChunkWriter::ChunkWriter(const ChunkFormat& format) : m_file(kHeader, '\0') {
    std::memcpy(m_file.data(), format.mark, kMark);
    std::memcpy(m_file.data() + kMark, &format.version, 4);
}

// Compresses in place, because chunks are as large as everything else that is still held when a
// bake is written.
void ChunkWriter::add(const char* name, const std::string& plain) {
    const std::size_t header = m_file.size(), from = header + kChunkHeader,
                      maxSize = ZSTD_compressBound(plain.size());
    m_file.resize(from + maxSize);
    const std::size_t packed =
        ZSTD_compress(m_file.data() + from, maxSize, plain.data(), plain.size(), 3);
    m_file.resize(from + packed);
    const std::uint64_t longs[3] = {plain.size(), packed, hashBytes(m_file.data() + from, packed)};
    std::memcpy(m_file.data() + header, name, 8);
    std::memcpy(m_file.data() + header + 8, longs, sizeof longs);
    ++m_count;
    std::memcpy(m_file.data() + kMark + 4, &m_count, 4);
}

Result<void> ChunkWriter::write(const std::string& path) const {
    return replaceFile(path, m_file);
}

Result<ChunkReader> ChunkReader::open(const std::string& path, const ChunkFormat& format,
                                      const MemoryBudget& memory) {
    Result<std::string> bytes = readFile(path);
    if (!bytes)
        return fail(fmt::format("{}: {}", path, bytes.error().message));
    ChunkReader file;
    file.m_path = path;
    file.m_bytes = std::move(*bytes);
    if (const Result<void> listed = file.list(format); !listed)
        return tl::make_unexpected(listed.error());
    std::uint64_t unpacked = 0;
    for (const auto& [name, chunk] : file.m_chunks)
        unpacked += std::min(chunk.plainSize, std::uint64_t(1) << 40);
    if (const Result<void> fits = memory.allow("the bake", 2 * unpacked); !fits)
        return fail(fmt::format("{}: {}", path, fits.error().message));
    return file;
}

Result<void> ChunkReader::list(const ChunkFormat& format) {
    if (m_bytes.size() < kHeader || std::memcmp(m_bytes.data(), format.mark, kMark) != 0)
        return fail(fmt::format("{}: not a bake file", m_path));
    std::uint32_t version, count;
    std::memcpy(&version, m_bytes.data() + kMark, 4);
    std::memcpy(&count, m_bytes.data() + kMark + 4, 4);
    if (version != format.version)
        return fail(
            fmt::format("{}: version {} is not {}: bake again", m_path, version, format.version));
    std::size_t offset = kHeader;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (m_bytes.size() - offset < kChunkHeader)
            return fail(fmt::format("{}: truncated after {} of {} chunks", m_path, i, count));
        const std::string name(m_bytes.data() + offset, 8);
        Chunk chunk;
        std::memcpy(&chunk.plainSize, m_bytes.data() + offset + 8, 8);
        std::memcpy(&chunk.packedSize, m_bytes.data() + offset + 16, 8);
        std::memcpy(&chunk.hash, m_bytes.data() + offset + 24, 8);
        offset += kChunkHeader;
        if (chunk.packedSize > m_bytes.size() - offset)
            return fail(fmt::format("{}: chunk {}: truncated or damaged", m_path, i));
        chunk.offset = offset;
        offset += std::size_t(chunk.packedSize);
        m_chunks[name] = chunk;
    }
    if (offset != m_bytes.size())
        return fail(
            fmt::format("{}: {} bytes after the last chunk", m_path, m_bytes.size() - offset));
    return {};
}

Result<std::string> ChunkReader::unpack(const char* name) const {
    const auto it = m_chunks.find(name);
    if (it == m_chunks.end())
        return fail(fmt::format("{}: chunk {}: missing", m_path, name));
    const Chunk& chunk = it->second;
    const char* packed = m_bytes.data() + chunk.offset;
    const auto packedSize = std::size_t(chunk.packedSize);
    if (hashBytes(packed, packedSize) != chunk.hash)
        return fail(fmt::format("{}: chunk {}: checksum does not match", m_path, name));
    if (ZSTD_getFrameContentSize(packed, packedSize) != chunk.plainSize)
        return fail(fmt::format("{}: chunk {}: wrong length", m_path, name));
    std::string plain(std::size_t(chunk.plainSize), '\0');
    const std::size_t n = ZSTD_decompress(plain.data(), plain.size(), packed, packedSize);
    if (ZSTD_isError(n) || n != plain.size())
        return fail(fmt::format("{}: chunk {}: cannot be unpacked", m_path, name));
    return plain;
}

} // namespace limn
