// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_schema.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace limn {

using Json = nlohmann::json;

namespace {

enum class Type {
    Number,   ///< finite as a float; `size` of them where size > 0
    Integer,  ///< an index, count, length or enum: [0, 2^53]
    Index,    ///< into the root array `into`
    Indices,  ///< an array of them
    IndexMap, ///< an object whose values are indices
    String,
    Bool,
    Object, ///< one with `fields`
    Objects ///< an array of them
};

struct Field {
    std::string_view name;
    Type type;
    bool required = false;
    int size = 0;
    std::string_view into = {};
    std::span<const Field> fields = {};
};

} // namespace

static constexpr bool kRequired = true;

static constexpr Field kTextureInfo[] = {{"index", Type::Index, kRequired, 0, "textures"},
                                         {"texCoord", Type::Integer}};
static constexpr Field kNormalTexture[] = {{"index", Type::Index, kRequired, 0, "textures"},
                                           {"texCoord", Type::Integer},
                                           {"scale", Type::Number}};
static constexpr Field kPbr[] = {
    {"baseColorFactor", Type::Number, false, 4},
    {"baseColorTexture", Type::Object, false, 0, {}, kTextureInfo},
    {"metallicFactor", Type::Number},
    {"roughnessFactor", Type::Number},
    {"metallicRoughnessTexture", Type::Object, false, 0, {}, kTextureInfo}};
static constexpr Field kMaterial[] = {{"name", Type::String},
                                      {"pbrMetallicRoughness", Type::Object, false, 0, {}, kPbr},
                                      {"normalTexture", Type::Object, false, 0, {}, kNormalTexture},
                                      {"emissiveTexture", Type::Object, false, 0, {}, kTextureInfo},
                                      {"emissiveFactor", Type::Number, false, 3},
                                      {"alphaMode", Type::String},
                                      {"alphaCutoff", Type::Number},
                                      {"doubleSided", Type::Bool}};
static constexpr Field kSparseIndices[] = {{"bufferView", Type::Index, kRequired, 0, "bufferViews"},
                                           {"byteOffset", Type::Integer},
                                           {"componentType", Type::Integer, kRequired}};
static constexpr Field kSparseValues[] = {{"bufferView", Type::Index, kRequired, 0, "bufferViews"},
                                          {"byteOffset", Type::Integer}};
static constexpr Field kSparse[] = {{"count", Type::Integer, kRequired},
                                    {"indices", Type::Object, kRequired, 0, {}, kSparseIndices},
                                    {"values", Type::Object, kRequired, 0, {}, kSparseValues}};
static constexpr Field kAccessor[] = {{"bufferView", Type::Index, false, 0, "bufferViews"},
                                      {"byteOffset", Type::Integer},
                                      {"componentType", Type::Integer, kRequired},
                                      {"normalized", Type::Bool},
                                      {"count", Type::Integer, kRequired},
                                      {"type", Type::String, kRequired},
                                      {"sparse", Type::Object, false, 0, {}, kSparse}};
static constexpr Field kBuffer[] = {{"uri", Type::String},
                                    {"byteLength", Type::Integer, kRequired}};
static constexpr Field kBufferView[] = {{"buffer", Type::Index, kRequired, 0, "buffers"},
                                        {"byteOffset", Type::Integer},
                                        {"byteLength", Type::Integer, kRequired},
                                        {"byteStride", Type::Integer}};
static constexpr Field kPerspective[] = {{"aspectRatio", Type::Number},
                                         {"yfov", Type::Number, kRequired},
                                         {"zfar", Type::Number},
                                         {"znear", Type::Number, kRequired}};
static constexpr Field kCamera[] = {{"name", Type::String},
                                    {"type", Type::String, kRequired},
                                    {"perspective", Type::Object, false, 0, {}, kPerspective}};
static constexpr Field kImage[] = {{"name", Type::String},
                                   {"uri", Type::String},
                                   {"mimeType", Type::String},
                                   {"bufferView", Type::Index, false, 0, "bufferViews"}};
static constexpr Field kPrimitive[] = {{"attributes", Type::IndexMap, kRequired, 0, "accessors"},
                                       {"indices", Type::Index, false, 0, "accessors"},
                                       {"material", Type::Index, false, 0, "materials"},
                                       {"mode", Type::Integer}};
static constexpr Field kMesh[] = {{"name", Type::String},
                                  {"primitives", Type::Objects, kRequired, 0, {}, kPrimitive}};
static constexpr Field kNode[] = {{"name", Type::String},
                                  {"camera", Type::Index, false, 0, "cameras"},
                                  {"children", Type::Indices, false, 0, "nodes"},
                                  {"mesh", Type::Index, false, 0, "meshes"},
                                  {"skin", Type::Index, false, 0, "skins"},
                                  {"matrix", Type::Number, false, 16},
                                  {"rotation", Type::Number, false, 4},
                                  {"scale", Type::Number, false, 3},
                                  {"translation", Type::Number, false, 3}};
static constexpr Field kSampler[] = {
    {"magFilter", Type::Integer}, {"wrapS", Type::Integer}, {"wrapT", Type::Integer}};
static constexpr Field kScene[] = {{"name", Type::String},
                                   {"nodes", Type::Indices, false, 0, "nodes"}};
static constexpr Field kSkin[] = {{"inverseBindMatrices", Type::Index, false, 0, "accessors"},
                                  {"joints", Type::Indices, kRequired, 0, "nodes"}};
// A texture without its image is white and reported, like one whose file is missing.
static constexpr Field kTexture[] = {{"sampler", Type::Integer}, {"source", Type::Integer}};
static constexpr Field kAsset[] = {{"version", Type::String, kRequired},
                                   {"minVersion", Type::String}};
static constexpr Field kRoot[] = {{"asset", Type::Object, kRequired, 0, {}, kAsset},
                                  {"accessors", Type::Objects, false, 0, {}, kAccessor},
                                  {"buffers", Type::Objects, false, 0, {}, kBuffer},
                                  {"bufferViews", Type::Objects, false, 0, {}, kBufferView},
                                  {"cameras", Type::Objects, false, 0, {}, kCamera},
                                  {"images", Type::Objects, false, 0, {}, kImage},
                                  {"materials", Type::Objects, false, 0, {}, kMaterial},
                                  {"meshes", Type::Objects, false, 0, {}, kMesh},
                                  {"nodes", Type::Objects, false, 0, {}, kNode},
                                  {"samplers", Type::Objects, false, 0, {}, kSampler},
                                  {"scene", Type::Index, false, 0, "scenes"},
                                  {"scenes", Type::Objects, false, 0, {}, kScene},
                                  {"skins", Type::Objects, false, 0, {}, kSkin},
                                  {"textures", Type::Objects, false, 0, {}, kTexture}};

using Problem = std::optional<std::string>; ///< "field: reason"

static Problem problem(const std::string& path, std::string_view reason) {
    return fmt::format("{}: {}", path, reason);
}

static bool isFloat(const Json& value) {
    return value.is_number() &&
           std::abs(value.get<double>()) <= double(std::numeric_limits<float>::max());
}

static Problem checkInteger(const Json& value, const std::string& path) {
    // Some exporters write 3.0 for 3. tinygltf accepts that, and so do we.
    const double number = value.is_number() ? value.get<double>() : -1;
    if (!(number >= 0 && number <= 9007199254740992.0 && number == std::floor(number)))
        return problem(path, "not a non-negative integer");
    return {};
}

static Problem checkIndex(const Json& value, const std::string& path, const Json& root,
                          std::string_view into) {
    if (Problem p = checkInteger(value, path))
        return p;
    const auto array = root.find(into);
    const std::size_t size = array == root.end() ? 0 : array->size();
    if (value.get<double>() >= double(size))
        return problem(path, fmt::format("index {} is out of range, there are {} {}",
                                         value.get<std::uint64_t>(), size, into));
    return {};
}

static Problem checkFields(const Json& object, std::span<const Field> fields,
                           const std::string& path, const Json& root);

static Problem checkValue(const Json& value, const Field& field, const std::string& path,
                          const Json& root) {
    switch (field.type) {
    case Type::Number:
        if (field.size == 0)
            return isFloat(value) ? Problem() : problem(path, "not a number");
        if (!value.is_array() || value.size() != std::size_t(field.size))
            return problem(path, fmt::format("not {} numbers", field.size));
        for (const Json& number : value)
            if (!isFloat(number))
                return problem(path, fmt::format("not {} numbers", field.size));
        return {};
    case Type::Integer:
        return checkInteger(value, path);
    case Type::Index:
        return checkIndex(value, path, root, field.into);
    case Type::Indices:
    case Type::IndexMap: {
        const bool map = field.type == Type::IndexMap;
        if (map ? !value.is_object() : !value.is_array())
            return problem(path, map ? "not an object" : "not an array");
        std::size_t i = 0;
        for (const auto& [key, index] : value.items()) {
            const std::string itemPath = map ? path + "." + key : fmt::format("{}[{}]", path, i++);
            if (Problem p = checkIndex(index, itemPath, root, field.into))
                return p;
        }
        return {};
    }
    case Type::String:
        return value.is_string() ? Problem() : problem(path, "not a string");
    case Type::Bool:
        return value.is_boolean() ? Problem() : problem(path, "not true or false");
    case Type::Object:
        return checkFields(value, field.fields, path, root);
    case Type::Objects:
        if (!value.is_array())
            return problem(path, "not an array");
        for (std::size_t i = 0; i < value.size(); ++i)
            if (Problem p =
                    checkFields(value[i], field.fields, fmt::format("{}[{}]", path, i), root))
                return p;
        return {};
    }
    return {};
}

static Problem checkFields(const Json& object, std::span<const Field> fields,
                           const std::string& path, const Json& root) {
    if (!object.is_object())
        return problem(path.empty() ? "JSON" : path, "not an object");
    for (const Field& field : fields) {
        const std::string fieldPath =
            fmt::format("{}{}{}", path, path.empty() ? "" : ".", field.name);
        const auto value = object.find(field.name);
        if (value == object.end()) {
            if (field.required)
                return problem(fieldPath, "missing");
            continue;
        }
        if (Problem p = checkValue(*value, field, fieldPath, root))
            return p;
    }
    const auto extensions = object.find("extensions");
    if (extensions != object.end() && !extensions->is_object())
        return problem(fmt::format("{}{}extensions", path, path.empty() ? "" : "."),
                       "not an object");
    return {};
}

static Problem checkNames(const Json& root, const char* key) {
    const auto names = root.find(key);
    if (names == root.end())
        return {};
    if (!names->is_array())
        return problem(key, "not an array");
    for (std::size_t i = 0; i < names->size(); ++i)
        if (!(*names)[i].is_string())
            return problem(fmt::format("{}[{}]", key, i), "not a string");
    return {};
}

static Problem checkVersion(const Json& root) {
    const Json& asset = root["asset"];
    const std::string version = asset["version"], minVersion = asset.value("minVersion", "2.0");
    if (!version.starts_with("2."))
        return problem("asset.version", fmt::format("glTF {} is not supported", version));
    if (minVersion != "2.0")
        return problem("asset.minVersion", fmt::format("glTF {} is not supported", minVersion));
    return {};
}

/// Checks the buffer views of images: tinygltf takes an image's address in a buffer without
/// checking that it lies there.
static Problem checkImageViews(const Json& root) {
    const Json& images = root.value("images", Json::array());
    for (std::size_t i = 0; i < images.size(); ++i) {
        const auto index = images[i].find("bufferView");
        if (index == images[i].end())
            continue;
        const Json& view = root["bufferViews"][index->get<std::size_t>()];
        const Json& buffer = root["buffers"][view["buffer"].get<std::size_t>()];
        const double offset = view.value("byteOffset", 0.0), length = view["byteLength"],
                     size = buffer["byteLength"];
        if (offset + length > size)
            return problem(
                fmt::format("images[{}].bufferView", i),
                fmt::format("{} bytes at {} exceed the buffer's {}", length, offset, size));
    }
    return {};
}

Result<void> checkGltfSchema(const Json& root) {
    Problem p = checkFields(root, kRoot, "", root);
    if (!p)
        p = checkNames(root, "extensionsRequired");
    if (!p)
        p = checkNames(root, "extensionsUsed");
    if (!p)
        p = checkVersion(root);
    if (!p)
        p = checkImageViews(root);
    if (p)
        return fail(*p);
    return {};
}

} // namespace limn
