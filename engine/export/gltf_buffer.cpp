// SPDX-License-Identifier: MIT
#include "engine/export/gltf_buffer.h"

#include "engine/core/append_word.h"
#include "engine/export/vector_json.h"

#include <limits>
#include <vector>

#include <glm/common.hpp>

namespace limn {

namespace {

// Numbers of the glTF 2.0 specification.
constexpr int kVertexTarget = 34962, kIndexTarget = 34963;
constexpr int kFloat = 5126, kUint16 = 5123, kUint32 = 5125;

/// Returns the index of the view, which has no target yet.
std::size_t appendView(GltfBuffer& buffer, const void* data, std::size_t size) {
    buffer.bytes.resize((buffer.bytes.size() + 3) / 4 * 4, '\0');
    buffer.views.push_back(
        {{"buffer", 0}, {"byteOffset", buffer.bytes.size()}, {"byteLength", size}});
    buffer.bytes.append(static_cast<const char*>(data), size);
    return buffer.views.size() - 1;
}

std::size_t append(GltfBuffer& buffer, const void* data, std::size_t size, int target,
                   Json accessor) {
    const std::size_t view = appendView(buffer, data, size);
    buffer.views[view]["target"] = target;
    accessor["bufferView"] = view;
    buffer.accessors.push_back(std::move(accessor));
    return buffer.accessors.size() - 1;
}

template <class T>
std::size_t addFloats(GltfBuffer& buffer, std::span<const T> values, const char* type) {
    return append(buffer, values.data(), values.size_bytes(), kVertexTarget,
                  {{"componentType", kFloat}, {"count", values.size()}, {"type", type}});
}

} // namespace

std::size_t GltfBuffer::add(std::span<const glm::vec2> values) {
    return addFloats(*this, values, "VEC2");
}

std::size_t GltfBuffer::add(std::span<const glm::vec3> values) {
    return addFloats(*this, values, "VEC3");
}

std::size_t GltfBuffer::add(std::span<const glm::vec4> values) {
    return addFloats(*this, values, "VEC4");
}

std::size_t GltfBuffer::addPositions(std::span<const glm::vec3> values) {
    const std::size_t accessor = add(values);
    glm::vec3 lower = values.front(), upper = lower;
    for (const glm::vec3 p : values) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    accessors[accessor]["min"] = vectorJson(lower);
    accessors[accessor]["max"] = vectorJson(upper);
    return accessor;
}

std::size_t GltfBuffer::addIndices(std::span<const std::uint32_t> values, std::size_t vertices) {
    Json accessor = {{"componentType", kUint32}, {"count", values.size()}, {"type", "SCALAR"}};
    if (vertices >= 65535) // the largest 16-bit index is reserved
        return append(*this, values.data(), values.size_bytes(), kIndexTarget, accessor);
    const std::vector<std::uint16_t> narrow(values.begin(), values.end());
    accessor["componentType"] = kUint16;
    return append(*this, narrow.data(), narrow.size() * sizeof(std::uint16_t), kIndexTarget,
                  accessor);
}

std::size_t GltfBuffer::addFile(std::string_view file) {
    return appendView(*this, file.data(), file.size());
}

// glTF 2.0 specification, section 4 "GLB File Format Specification".
Result<std::string> binaryGltf(const Json& document, const std::string& buffer) {
    constexpr std::uint32_t kMagic = 0x46546c67, kVersion = 2, kJson = 0x4e4f534a, kBin = 0x4e4942;
    std::string json = document.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::size_t padded = (buffer.size() + 3) / 4 * 4;
    const std::uint64_t length = 12 + 8 + std::uint64_t(json.size()) + 8 + padded;
    if (length > std::numeric_limits<std::uint32_t>::max())
        return fail("a .glb file holds 4 GiB at most; write a .gltf file");
    std::string out;
    out.reserve(length);
    for (const std::uint32_t word : {kMagic, kVersion, std::uint32_t(length)})
        appendWord(out, word);
    appendWord(out, std::uint32_t(json.size()));
    appendWord(out, kJson);
    out += json;
    appendWord(out, std::uint32_t(padded));
    appendWord(out, kBin);
    out += buffer;
    out.resize(length, '\0');
    return out;
}

} // namespace limn
