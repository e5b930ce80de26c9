// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/bake_file.h"

#include "engine/core/archive.h"
#include "engine/core/hash.h"
#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"
#include "engine/techniques/illuminance/bake/bake_defect.h"
#include "engine/techniques/illuminance/bake/bake_fields.h"

#include <algorithm>
#include <cstring>
#include <map>

#include <fmt/format.h>
#include <zstd.h>

// File: "LIMNBAKE", u32 version, u32 chunk count, then per chunk:
//   char[8] name, u64 bytes unpacked, u64 bytes packed, u64 XXH3 of the packed bytes, packed bytes
//   (zstd).
// Little-endian; numbers and arrays as in memory: an array is a u64 count and its elements.

namespace limn {

namespace {

constexpr char kMagic[8] = {'L', 'I', 'M', 'N', 'B', 'A', 'K', 'E'};
constexpr std::uint32_t kVersion = 5;

constexpr std::size_t kHeader = sizeof kMagic + 8, kChunkHeader = 8 + 3 * 8;

/// Compresses in place, because chunks are as large as everything else that a bake still holds when
/// it is written.
void appendChunk(const char* name, const std::string& plain, std::string& out) {
    const std::size_t at = out.size(), from = at + kChunkHeader,
                      most = ZSTD_compressBound(plain.size());
    out.resize(from + most);
    const std::size_t packed =
        ZSTD_compress(out.data() + from, most, plain.data(), plain.size(), 3);
    out.resize(from + packed);
    const std::uint64_t longs[3] = {plain.size(), packed, hashBytes(out.data() + from, packed)};
    std::memcpy(out.data() + at, name, 8);
    std::memcpy(out.data() + at + 8, longs, sizeof longs);
}

struct Chunk {
    std::uint64_t plainSize, packedSize, hash;
    const char* packed;
};

Result<std::map<std::string, Chunk>> listChunks(const std::string& path, const std::string& bytes) {
    if (bytes.size() < kHeader || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0)
        return fail(fmt::format("{}: not a bake file", path));
    std::uint32_t version, count;
    std::memcpy(&version, bytes.data() + 8, 4);
    std::memcpy(&count, bytes.data() + 12, 4);
    if (version != kVersion)
        return fail(fmt::format("{}: version {} is not {}: bake again", path, version, kVersion));
    std::map<std::string, Chunk> chunks;
    std::size_t at = kHeader;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (bytes.size() - at < kChunkHeader)
            return fail(fmt::format("{}: truncated after {} of {} chunks", path, i, count));
        const std::string name(bytes.data() + at, 8);
        Chunk chunk;
        std::memcpy(&chunk.plainSize, bytes.data() + at + 8, 8);
        std::memcpy(&chunk.packedSize, bytes.data() + at + 16, 8);
        std::memcpy(&chunk.hash, bytes.data() + at + 24, 8);
        at += kChunkHeader;
        if (chunk.packedSize > bytes.size() - at)
            return fail(fmt::format("{}: chunk {}: truncated or damaged", path, i));
        chunk.packed = bytes.data() + at;
        at += std::size_t(chunk.packedSize);
        chunks[name] = chunk;
    }
    if (at != bytes.size())
        return fail(fmt::format("{}: {} bytes after the last chunk", path, bytes.size() - at));
    return chunks;
}

Result<std::string> unpack(const std::string& path, const char* name, const Chunk& chunk) {
    const auto packedSize = std::size_t(chunk.packedSize);
    if (hashBytes(chunk.packed, packedSize) != chunk.hash)
        return fail(fmt::format("{}: chunk {}: checksum does not match", path, name));
    if (ZSTD_getFrameContentSize(chunk.packed, packedSize) != chunk.plainSize)
        return fail(fmt::format("{}: chunk {}: wrong length", path, name));
    std::string plain(std::size_t(chunk.plainSize), '\0');
    const std::size_t n = ZSTD_decompress(plain.data(), plain.size(), chunk.packed, packedSize);
    if (ZSTD_isError(n) || n != plain.size())
        return fail(fmt::format("{}: chunk {}: cannot be unpacked", path, name));
    return plain;
}

} // namespace

Result<void> writeBake(const std::string& path, const Bake& bake) {
    std::string file(kHeader, '\0');
    std::uint32_t count = 0;
    forBakeChunks(nullptr, [&](const char* name, auto fields) {
        ByteWriter archive;
        fields(archive, bake);
        appendChunk(name, archive.bytes, file);
        ++count;
    });
    const std::uint32_t words[2] = {kVersion, count};
    std::memcpy(file.data(), kMagic, sizeof kMagic);
    std::memcpy(file.data() + sizeof kMagic, words, sizeof words);
    return replaceFile(path, file);
}

Result<Bake> readBake(const std::string& path, const MemoryBudget& memory) {
    const Result<std::string> bytes = readFile(path);
    if (!bytes)
        return fail(fmt::format("{}: {}", path, bytes.error().message));
    const Result<std::map<std::string, Chunk>> chunks = listChunks(path, *bytes);
    if (!chunks)
        return tl::make_unexpected(chunks.error());
    std::uint64_t unpacked = 0;
    for (const auto& [name, chunk] : *chunks)
        unpacked += std::min(chunk.plainSize, std::uint64_t(1) << 40);
    if (const Result<void> fits = memory.allow("the bake", 2 * unpacked); !fits)
        return fail(fmt::format("{}: {}", path, fits.error().message));
    Bake bake;
    std::string defect;
    forBakeChunks(nullptr, [&](const char* name, auto fields) {
        if (!defect.empty())
            return;
        const auto it = chunks->find(name);
        if (it == chunks->end()) {
            defect = fmt::format("{}: chunk {}: missing", path, name);
            return;
        }
        const Result<std::string> plain = unpack(path, name, it->second);
        if (!plain) {
            defect = plain.error().message;
            return;
        }
        ByteReader archive(*plain);
        fields(archive, bake);
        if (!archive.ok || !archive.atEnd())
            defect = fmt::format("{}: chunk {}: wrong length", path, name);
    });
    if (!defect.empty())
        return fail(defect);
    if (defect = bakeDefect(bake, nullptr); !defect.empty())
        return fail(fmt::format("{}: {}", path, defect));
    return bake;
}

} // namespace limn
