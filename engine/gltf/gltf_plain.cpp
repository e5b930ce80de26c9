// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_plain.h"

#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

namespace limn {

using Json = nlohmann::json;

/// Recursive; readJson() has refused JSON that is nested deeply.
static void writeIntegers(Json& value) {
    if (value.is_structured()) {
        for (Json& member : value)
            writeIntegers(member);
        return;
    }
    if (!value.is_number_float())
        return;
    const double number = value.get<double>();
    if (std::abs(number) <= double(std::numeric_limits<std::int32_t>::max()) &&
        number == std::floor(number))
        value = std::int64_t(number);
}

/// Whether a buffer without data stands for what EXT_meshopt_compression unpacks.
static bool isFallback(const Json& buffer) {
    const Json none = Json::object();
    const Json& extensions = buffer.contains("extensions") ? buffer["extensions"] : none;
    const auto found = extensions.find("EXT_meshopt_compression");
    return !buffer.contains("uri") && found != extensions.end() && found->is_object() &&
           found->value("fallback", Json(false)) == Json(true);
}

static std::vector<GltfSource> takeBuffers(Json& json, bool hasBinary) {
    std::vector<GltfSource> sources;
    const auto buffers = json.find("buffers");
    for (std::size_t i = 0; buffers != json.end() && i < buffers->size(); ++i) {
        Json& buffer = (*buffers)[i];
        GltfSource source{.isBuffer = true, .index = i};
        source.uri = buffer.value("uri", "");
        source.length = isFallback(buffer) ? 0 : std::uint64_t(buffer.value("byteLength", 0.0));
        if (source.uri.empty() && source.length > 0 && !(hasBinary && i == 0))
            source.problem = "missing";
        buffer["uri"] = "buffer";
        if (source.length == 0) // tinygltf refuses empty files
            buffer["byteLength"] = 1;
        sources.push_back(std::move(source));
    }
    return sources;
}

static std::vector<GltfSource> takeImages(Json& json) {
    std::vector<GltfSource> sources;
    const auto images = json.find("images");
    for (std::size_t i = 0; images != json.end() && i < images->size(); ++i) {
        Json& image = (*images)[i];
        GltfSource source{.index = i};
        source.uri = image.value("uri", "");
        const bool hasView = image.contains("bufferView");
        if (hasView && source.uri.empty()) {
            image.erase("uri");
            continue;
        }
        if (hasView)
            source.problem = "has both a uri and a buffer view";
        else if (source.uri.empty())
            source.problem = "has no data";
        image.erase("bufferView");
        image["uri"] = "image";
        sources.push_back(std::move(source));
    }
    return sources;
}

/// tinygltf passes over channels without a node, such as those of KHR_animation_pointer.
static void giveNodes(Json& json) {
    const auto animations = json.find("animations");
    if (animations == json.end() || !animations->is_array())
        return;
    for (Json& animation : *animations) {
        if (!animation.is_object() || !animation.contains("channels"))
            continue;
        for (Json& channel : animation["channels"])
            if (channel.is_object() && channel.contains("target") &&
                channel["target"].is_object() && channel["target"].contains("extensions") &&
                !channel["target"].contains("node"))
                channel["target"]["node"] = 0;
    }
}

/// tinygltf refuses accessors of indices without a buffer view, such as those that Draco unpacks.
static void takePackedIndices(Json& json) {
    const auto meshes = json.find("meshes");
    for (std::size_t m = 0; meshes != json.end() && m < meshes->size(); ++m)
        for (Json& primitive : (*meshes)[m]["primitives"])
            if (primitive.contains("extensions") &&
                primitive["extensions"].contains("KHR_draco_mesh_compression"))
                primitive.erase("indices");
}

std::vector<GltfSource> makePlain(Json& json, bool hasBinary) {
    writeIntegers(json);
    takePackedIndices(json);
    giveNodes(json);
    std::vector<GltfSource> sources = takeBuffers(json, hasBinary);
    for (GltfSource& image : takeImages(json))
        sources.push_back(std::move(image));
    return sources;
}

} // namespace limn
