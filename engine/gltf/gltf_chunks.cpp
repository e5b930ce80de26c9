// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_chunks.h"

#include <cstdint>
#include <cstring>

#include <fmt/format.h>

namespace limn {

static constexpr std::size_t kHeader = 12, kChunkHeader = 8;
static constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;

static std::uint32_t wordAt(std::string_view bytes, std::size_t offset) {
    std::uint32_t word;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

static Result<GltfChunks> splitGlb(std::string_view bytes) {
    if (bytes.size() < kHeader + kChunkHeader)
        return fail("GLB header: truncated");
    const std::uint32_t version = wordAt(bytes, 4), length = wordAt(bytes, 8);
    if (version != 2)
        return fail(fmt::format("GLB header: version {} is not supported", version));
    if (length > bytes.size())
        return fail(
            fmt::format("GLB header: length {} exceeds the file's {} bytes", length, bytes.size()));
    bytes = bytes.substr(0, length);
    GltfChunks chunks;
    std::size_t offset = kHeader;
    for (std::size_t number = 0; offset + kChunkHeader <= bytes.size(); ++number) {
        const std::uint32_t size = wordAt(bytes, offset), type = wordAt(bytes, offset + 4);
        offset += kChunkHeader;
        if (number == 0 && type != kJson)
            return fail("GLB: the first chunk is not JSON");
        if (size > bytes.size() - offset)
            return fail(fmt::format("GLB: the {} exceeds the file",
                                    number == 0 ? "JSON chunk" : fmt::format("chunk {}", number)));
        if (number == 0)
            chunks.json = bytes.substr(offset, size);
        else if (type == kBinary && !chunks.binary)
            chunks.binary = bytes.substr(offset, size);
        offset += size;
    }
    return chunks;
}

Result<GltfChunks> splitGltf(std::string_view bytes) {
    if (bytes.starts_with("glTF"))
        return splitGlb(bytes);
    const std::size_t first = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (first != std::string_view::npos && bytes[first] != '{')
        return fail("neither glTF nor GLB");
    return GltfChunks{bytes, {}};
}

} // namespace limn
