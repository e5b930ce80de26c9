// SPDX-License-Identifier: MIT
#include "engine/export/gltf_buffer.h"

#include "engine/core/append_word.h"
#include "engine/export/gltf_meshopt.h"
#include "engine/export/gltf_quantization.h"

#include <limits>
#include <utility>
#include <vector>

#include <glm/common.hpp>

namespace limn {

namespace {

// Numbers of the glTF 2.0 specification.
constexpr int kVertexTarget = 34962, kIndexTarget = 34963;
constexpr int kInt8 = 5120, kFloat = 5126, kUint16 = 5123, kUint32 = 5125;

/// The elements of an accessor.
struct Elements {
    const void* data;
    std::size_t count, stride; ///< [bytes]
    std::size_t bytes() const { return count * stride; }
};

template <class T>
Elements elementsOf(const T& values) {
    return {values.data(), values.size(), sizeof(*values.data())};
}

std::size_t padded(std::size_t size) {
    return (size + 3) / 4 * 4;
}

/// Appends to the buffer and returns where.
std::size_t put(GltfBuffer& buffer, std::string_view data) {
    buffer.bytes.resize(padded(buffer.bytes.size()), '\0');
    const std::size_t offset = buffer.bytes.size();
    buffer.bytes += data;
    return offset;
}

/// Returns the index of the view, which has no target yet.
std::size_t appendView(GltfBuffer& buffer, std::string_view data) {
    const std::size_t offset = put(buffer, data);
    buffer.views.push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", data.size()}});
    return buffer.views.size() - 1;
}

/// The same of elements that `packed` are in the extension's mode; as they are where that takes
/// fewer bytes.
std::size_t appendPacked(GltfBuffer& buffer, const Elements& elements, const std::string& packed,
                         const char* mode) {
    if (packed.size() >= elements.bytes())
        return appendView(buffer, {static_cast<const char*>(elements.data), elements.bytes()});
    Json view = {
        {"buffer", 1}, {"byteOffset", buffer.unpackedBytes}, {"byteLength", elements.bytes()}};
    view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                     {"byteOffset", put(buffer, packed)},
                                                     {"byteLength", packed.size()},
                                                     {"byteStride", elements.stride},
                                                     {"mode", mode},
                                                     {"count", elements.count}};
    buffer.unpackedBytes += padded(elements.bytes());
    buffer.views.push_back(std::move(view));
    return buffer.views.size() - 1;
}

std::size_t addAccessor(GltfBuffer& buffer, std::size_t view, Json accessor) {
    accessor["bufferView"] = view;
    buffer.accessors.push_back(std::move(accessor));
    return buffer.accessors.size() - 1;
}

/// `shown`: bytes of an element that its accessor reads.
std::size_t addVertices(GltfBuffer& buffer, const Elements& elements, std::size_t shown,
                        int component, const char* type) {
    const std::size_t view =
        buffer.packing.meshopt
            ? appendPacked(buffer, elements,
                           meshoptVertices(elements.data, elements.count, elements.stride),
                           "ATTRIBUTES")
            : appendView(buffer, {static_cast<const char*>(elements.data), elements.bytes()});
    buffer.views[view]["target"] = kVertexTarget;
    if (shown < elements.stride)
        buffer.views[view]["byteStride"] = elements.stride;
    Json accessor = {{"componentType", component}, {"count", elements.count}, {"type", type}};
    if (component != kFloat)
        accessor["normalized"] = true;
    return addAccessor(buffer, view, std::move(accessor));
}

std::size_t addFloats(GltfBuffer& buffer, const Elements& elements, const char* type) {
    return addVertices(buffer, elements, elements.stride, kFloat, type);
}

template <class Values>
void putBounds(Json& accessor, const Values& values) {
    auto lower = values[0], upper = values[0];
    for (const auto& v : values) {
        lower = glm::min(lower, v);
        upper = glm::max(upper, v);
    }
    accessor["min"] = {lower.x, lower.y, lower.z};
    accessor["max"] = {upper.x, upper.y, upper.z};
}

} // namespace

std::size_t GltfBuffer::addNormals(std::span<const glm::vec3> values) {
    if (!packing.quantize)
        return addFloats(*this, elementsOf(values), "VEC3");
    return addVertices(*this, elementsOf(quantizedDirections(values)), 3, kInt8, "VEC3");
}

std::size_t GltfBuffer::addTangents(std::span<const glm::vec4> values) {
    if (!packing.quantize)
        return addFloats(*this, elementsOf(values), "VEC4");
    return addVertices(*this, elementsOf(quantizedTangents(values)), 4, kInt8, "VEC4");
}

std::size_t GltfBuffer::addTexCoords(std::span<const glm::vec2> values) {
    if (packing.quantize)
        if (const auto integers = quantizedUnit(values))
            return addVertices(*this, elementsOf(*integers), 4, kUint16, "VEC2");
    return addFloats(*this, elementsOf(values), "VEC2");
}

std::size_t GltfBuffer::addColors(std::span<const glm::vec4> values) {
    if (packing.quantize)
        if (const auto integers = quantizedUnit(values))
            return addVertices(*this, elementsOf(*integers), 8, kUint16, "VEC4");
    return addFloats(*this, elementsOf(values), "VEC4");
}

std::size_t GltfBuffer::addPositions(std::span<const glm::vec3> values, glm::mat4& toObject) {
    toObject = glm::mat4(1);
    if (!packing.quantize) {
        const std::size_t accessor = addFloats(*this, elementsOf(values), "VEC3");
        putBounds(accessors[accessor], values);
        return accessor;
    }
    const QuantizedCube cube = quantizedCube(boundsOf(values));
    toObject = fromQuantized(cube);
    const std::vector<glm::u16vec4> integers = quantizedPositions(values, cube);
    const std::size_t accessor = addVertices(*this, elementsOf(integers), 6, kUint16, "VEC3");
    putBounds(accessors[accessor], integers);
    return accessor;
}

std::size_t GltfBuffer::addIndices(std::span<const std::uint32_t> values, std::size_t vertices) {
    const bool isNarrow = vertices < 65535; // the largest 16-bit index is reserved
    const std::vector<std::uint32_t> ordered =
        packing.meshopt ? orderedTriangles(values, vertices)
                        : std::vector<std::uint32_t>(values.begin(), values.end());
    const std::vector<std::uint16_t> narrow =
        isNarrow ? std::vector<std::uint16_t>(ordered.begin(), ordered.end())
                 : std::vector<std::uint16_t>();
    const Elements elements = isNarrow ? elementsOf(narrow) : elementsOf(ordered);
    const std::size_t view =
        packing.meshopt
            ? appendPacked(*this, elements, meshoptTriangles(ordered, vertices), "TRIANGLES")
            : appendView(*this, {static_cast<const char*>(elements.data), elements.bytes()});
    views[view]["target"] = kIndexTarget;
    return addAccessor(*this, view,
                       {{"componentType", isNarrow ? kUint16 : kUint32},
                        {"count", values.size()},
                        {"type", "SCALAR"}});
}

std::size_t GltfBuffer::addFile(std::string_view file) {
    return appendView(*this, file);
}

// glTF 2.0 specification, section 4 "GLB File Format Specification".
Result<std::string> binaryGltf(const Json& document, const std::string& buffer) {
    constexpr std::uint32_t kMagic = 0x46546c67, kVersion = 2, kJson = 0x4e4f534a, kBin = 0x4e4942;
    std::string json = document.dump();
    json.resize(padded(json.size()), ' ');
    const std::size_t chunk = padded(buffer.size());
    const std::uint64_t length = 12 + 8 + std::uint64_t(json.size()) + 8 + chunk;
    if (length > std::numeric_limits<std::uint32_t>::max())
        return fail("a .glb file holds 4 GiB at most; write a .gltf file");
    std::string out;
    out.reserve(length);
    for (const std::uint32_t word : {kMagic, kVersion, std::uint32_t(length)})
        appendWord(out, word);
    appendWord(out, std::uint32_t(json.size()));
    appendWord(out, kJson);
    out += json;
    appendWord(out, std::uint32_t(chunk));
    appendWord(out, kBin);
    out += buffer;
    out.resize(length, '\0');
    return out;
}

} // namespace limn
