// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_size.h"

#include "engine/gltf/gltf_accessor.h"
#include "engine/gltf/gltf_image.h"
#include "engine/scene/decode_image.h"
#include "engine/scene/mesh/mesh.h"

#include <algorithm>

#include <fmt/format.h>

namespace limn {

namespace {

/// Bytes of a vertex, counted twice, as read and as kept: two attributes each of 3, 4 and 2 floats.
constexpr std::uint64_t kVertexBytes =
    2 * (2 * sizeof(glm::vec3) + 2 * sizeof(glm::vec4) + 2 * sizeof(glm::vec2));
constexpr std::uint64_t kIndexBytes = 2 * sizeof(std::uint32_t);
/// Memory per node in the document, in its lists of names, as an instance of the scene, and for
/// rays.
constexpr std::uint64_t kNodeBytes = 1024;

/// Number of elements of an accessor; 0 if it has no view or its view is too short.
std::uint64_t countOf(const tinygltf::Model& model, int index) {
    if (index < 0 || std::size_t(index) >= model.accessors.size())
        return 0;
    const tinygltf::Accessor& accessor = model.accessors[std::size_t(index)];
    const auto view = std::size_t(accessor.bufferView);
    const std::uint64_t maxCount = accessor.bufferView < 0 ? kMaxZeros
                                   : view < model.bufferViews.size()
                                       ? model.bufferViews[view].byteLength
                                       : 0;
    return accessor.count <= maxCount ? accessor.count : 0;
}

std::uint64_t countOf(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                      const char* attribute) {
    const auto found = primitive.attributes.find(attribute);
    return found == primitive.attributes.end() ? 0 : countOf(model, found->second);
}

struct Part {
    std::string what;
    std::uint64_t bytes = 0;
};

Part imagesOf(const GltfFile& file) {
    Part part{fmt::format("decoding its {} images", file.model.images.size())};
    for (std::size_t i = 0; i < file.model.images.size(); ++i)
        if (const auto bytes = encodedImage(file, i))
            if (const Result<ImageSize> size = imageSize(*bytes))
                part.bytes += std::uint64_t(4) * size->width * size->height;
    return part;
}

Part meshesOf(const tinygltf::Model& model) {
    Part part{fmt::format("its {} meshes", model.meshes.size())};
    std::vector<std::uint64_t> bytes;
    for (const tinygltf::Mesh& mesh : model.meshes) {
        bytes.push_back(0);
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            const std::uint64_t vertices = countOf(model, primitive, "POSITION");
            // Strips and fans have up to three corners for each index. Vertices that no corner uses
            // are not kept.
            const std::uint64_t corners =
                primitive.indices >= 0 ? countOf(model, primitive.indices) : vertices;
            bytes.back() += std::min(vertices, corners) * kVertexBytes + 3 * corners * kIndexBytes;
        }
        part.bytes += bytes.back();
    }
    for (const tinygltf::Node& node : model.nodes) // with morph weights or a skin of its own
        if ((!node.weights.empty() || node.skin >= 0) && node.mesh >= 0 &&
            std::size_t(node.mesh) < bytes.size())
            part.bytes += bytes[std::size_t(node.mesh)];
    return part;
}

Part nodesOf(const tinygltf::Model& model) {
    std::uint64_t nodes = model.nodes.size();
    for (const tinygltf::Node& node : model.nodes) {
        const auto instancing = node.extensions.find("EXT_mesh_gpu_instancing");
        if (instancing == node.extensions.end() || !instancing->second.IsObject() ||
            !instancing->second.Has("attributes"))
            continue;
        const tinygltf::Value& attributes = instancing->second.Get("attributes");
        std::uint64_t maxCount = 0;
        for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"})
            if (attributes.Has(name) && attributes.Get(name).IsInt())
                maxCount =
                    std::max(maxCount, countOf(model, attributes.Get(name).GetNumberAsInt()));
        nodes += maxCount;
    }
    return {fmt::format("its {} nodes and instances", nodes), nodes * kNodeBytes};
}

} // namespace

Result<void> checkGltfSize(const GltfFile& file, const MemoryBudget& memory) {
    const Part parts[] = {imagesOf(file), meshesOf(file.model), nodesOf(file.model)};
    std::uint64_t all = 0;
    for (const Part& part : parts) {
        if (Result<void> fits = memory.allow(part.what, part.bytes); !fits)
            return fits;
        all += part.bytes; // three parts of the budget at most: no overflow
    }
    return memory.allow("the scene", all);
}

std::uint64_t jsonBytes(std::string_view text) {
    // tinygltf keeps its own tree beside the JSON's, and a node for every object.
    constexpr std::uint64_t kPerValue = 200, kPerObject = 900;
    const auto values = std::uint64_t(std::ranges::count(text, ','));
    const auto objects = std::uint64_t(std::ranges::count(text, '{'));
    return 2 * text.size() + kPerValue * values + kPerObject * objects;
}

} // namespace limn
