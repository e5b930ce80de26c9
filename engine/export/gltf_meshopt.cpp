// SPDX-License-Identifier: MIT
#include "engine/export/gltf_meshopt.h"

#include <meshoptimizer.h>

namespace limn {

// The extension fixes the versions of both formats.
static constexpr int kVertexVersion = 0, kIndexVersion = 1;

static unsigned char* bytesOf(std::string& text) {
    return reinterpret_cast<unsigned char*>(text.data());
}

std::string meshoptVertices(const void* vertices, std::size_t count, std::size_t stride) {
    meshopt_encodeVertexVersion(kVertexVersion);
    std::string bytes(meshopt_encodeVertexBufferBound(count, stride), '\0');
    bytes.resize(meshopt_encodeVertexBuffer(bytesOf(bytes), bytes.size(), vertices, count, stride));
    return bytes;
}

std::string meshoptTriangles(std::span<const std::uint32_t> indices, std::size_t vertices) {
    meshopt_encodeIndexVersion(kIndexVersion);
    std::string bytes(meshopt_encodeIndexBufferBound(indices.size(), vertices), '\0');
    bytes.resize(
        meshopt_encodeIndexBuffer(bytesOf(bytes), bytes.size(), indices.data(), indices.size()));
    return bytes;
}

std::vector<std::uint32_t> orderedTriangles(std::span<const std::uint32_t> indices,
                                            std::size_t vertices) {
    std::vector<std::uint32_t> ordered(indices.size());
    meshopt_optimizeVertexCache(ordered.data(), indices.data(), indices.size(), vertices);
    return ordered;
}

} // namespace limn
