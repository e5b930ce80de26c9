// SPDX-License-Identifier: MIT
#include "engine/export/gltf_buffer.h"

#include "engine/export/vector_json.h"

#include <vector>

#include <glm/common.hpp>

namespace limn {

namespace {

// Numbers of the glTF 2.0 specification.
constexpr int kVertexTarget = 34962, kIndexTarget = 34963;
constexpr int kFloat = 5126, kUint16 = 5123, kUint32 = 5125;

std::size_t append(GltfBuffer& buffer, const void* data, std::size_t size, int target,
                   Json accessor) {
    buffer.bytes.resize((buffer.bytes.size() + 3) / 4 * 4, '\0');
    Json view = {{"buffer", 0}, {"byteOffset", buffer.bytes.size()}, {"byteLength", size}};
    view["target"] = target;
    buffer.bytes.append(static_cast<const char*>(data), size);
    accessor["bufferView"] = buffer.views.size();
    buffer.views.push_back(std::move(view));
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

} // namespace limn
