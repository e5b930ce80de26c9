// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/archive.h"
#include "engine/core/field_rule.h"
#include "engine/core/memory_budget.h"
#include "engine/core/result.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace limn {

/// A kind of file of named chunks: a mark of eight characters, u32 version, u32 chunk count, then
/// per chunk:
///   char[8] name, u64 bytes unpacked, u64 bytes packed, u64 XXH3 of the packed bytes, packed bytes
///   (zstd).
/// Little-endian; numbers and arrays as in memory: an array is a u64 count and its elements.
struct ChunkFormat {
    const char* mark; ///< eight characters
    std::uint32_t version;
    std::string_view optional = {}; ///< name of the chunk that older files lack; empty: none
};

/// Makes a file of chunks, each compressed when it is added.
class ChunkWriter {
public:
    explicit ChunkWriter(const ChunkFormat& format);
    /// `name` has eight characters.
    void add(const char* name, const std::string& plain);
    /// Writes the file to a temporary file and renames it.
    Result<void> write(const std::string& path) const;

private:
    std::string m_file;
    std::uint32_t m_count = 0;
};

/// The chunks of a file that was read.
class ChunkReader {
public:
    /// Fails on a file that is damaged, truncated, of another mark or version, or that would need
    /// more than `memory`.
    static Result<ChunkReader> open(const std::string& path, const ChunkFormat& format,
                                    const MemoryBudget& memory);
    bool has(std::string_view name) const { return m_chunks.count(std::string(name)) > 0; }
    /// The bytes of a chunk. Fails if it is missing or its checksum does not match.
    Result<std::string> unpack(const char* name) const;

private:
    struct Chunk {
        std::uint64_t plainSize, packedSize, hash;
        std::size_t offset; ///< of the packed bytes
    };
    Result<void> list(const ChunkFormat& format);

    std::string m_path, m_bytes;
    std::map<std::string, Chunk> m_chunks;
};

/// Writes a value whose chunks `forChunks` lists: forChunks(visit) calls visit(name, fields) for
/// each, and fields(archive, value) lists the fields.
template <class T, class ForChunks>
Result<void> writeChunks(const std::string& path, const ChunkFormat& format, const T& value,
                         const ForChunks& forChunks) {
    ChunkWriter writer(format);
    forChunks([&](const char* name, auto fields) {
        ByteWriter archive;
        fields(archive, value);
        writer.add(name, archive.bytes);
    });
    return writer.write(path);
}

/// Reads a value that writeChunks() wrote. Its rules are not checked. Fields of an optional chunk
/// that is missing keep their defaults.
template <class T, class ForChunks>
Result<T> readChunks(const std::string& path, const ChunkFormat& format, const MemoryBudget& memory,
                     const ForChunks& forChunks) {
    const Result<ChunkReader> file = ChunkReader::open(path, format, memory);
    if (!file)
        return tl::make_unexpected(file.error());
    T value;
    std::string defect;
    forChunks([&](const char* name, auto fields) {
        if (!defect.empty() || (name == format.optional && !file->has(name)))
            return;
        const Result<std::string> plain = file->unpack(name);
        if (!plain) {
            defect = plain.error().message;
            return;
        }
        ByteReader archive(*plain);
        fields(archive, value);
        if (!archive.ok || !archive.atEnd())
            defect = fmt::format("{}: chunk {}: wrong length", path, name);
    });
    if (!defect.empty())
        return fail(defect);
    return value;
}

/// The first chunk whose fields break their rules, and how; empty: none.
template <class T, class ForChunks>
std::string chunksDefect(const T& value, const ForChunks& forChunks) {
    std::string defect;
    forChunks([&](std::string name, auto fields) {
        if (!defect.empty())
            return;
        FieldCheck check;
        fields(check, value);
        name.erase(name.find_last_not_of(' ') + 1);
        if (!check.defect.empty())
            defect = fmt::format("{}: {}", name, check.defect);
    });
    return defect;
}

} // namespace limn
