// SPDX-License-Identifier: MIT
#include "engine/scene/gltf_file.h"

#include "engine/core/hash.h"
#include "engine/scene/gltf_schema.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace limn {

namespace fs = std::filesystem;

/// Extensions that may be required: what they say is read.
static constexpr std::array<std::string_view, 5> kKnownExtensions = {
    "EXT_mesh_gpu_instancing", "KHR_lights_punctual", "KHR_materials_emissive_strength",
    "KHR_mesh_quantization", "KHR_texture_transform"};

/// tinygltf descends recursively into extras.
static constexpr int kMaxJsonDepth = 128;

static bool readBytes(const std::string& path, std::vector<unsigned char>& out) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) // no devices, no pipes: they may never end
        return false;
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file)
        return false;
    const std::streamoff size = file.tellg();
    if (size < 0)
        return false;
    out.resize(std::size_t(size));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(out.data()), size);
    return bool(file);
}

namespace {

/// A buffer that lies in a file of its own.
struct ExternalBuffer {
    std::size_t index = 0; ///< in the root's `buffers`
    std::uint64_t length = 0;
};

/// What tinygltf's callbacks work on.
struct LoadState {
    fs::path folder;
    /// The buffers with a file, in order. Their files come first; they may be longer than their
    /// buffer, which tinygltf would refuse.
    std::vector<ExternalBuffer> buffers;
    std::size_t filesRead = 0;
    std::vector<std::vector<std::uint8_t>> encodedImages;
};

} // namespace

static bool fileExists(const std::string& path, void* user) {
    // tinygltf also looks into the working directory; what lies there is nobody's business.
    const fs::path& folder = static_cast<const LoadState*>(user)->folder;
    const std::string prefix = folder.empty() ? "" : folder.string();
    std::error_code error;
    return path.compare(0, prefix.size(), prefix) == 0 && fs::is_regular_file(path, error);
}

static std::string samePath(const std::string& path, void*) {
    return path;
}

static bool readWholeFile(std::vector<unsigned char>* out, std::string* error,
                          const std::string& path, void* user) {
    LoadState& state = *static_cast<LoadState*>(user);
    if (!readBytes(path, *out)) {
        if (error)
            *error = "cannot read";
        return false;
    }
    const std::size_t index = state.filesRead++;
    if (index < state.buffers.size() && out->size() > state.buffers[index].length)
        out->resize(std::size_t(state.buffers[index].length));
    return true;
}

/// Keeps the bytes for decoding in parallel. Images in buffer views are read later: tinygltf does
/// not check that the view lies within its buffer.
static bool keepEncoded(tinygltf::Image* image, int index, std::string*, std::string*, int, int,
                        const unsigned char* bytes, int size, void* user) {
    auto& images = static_cast<LoadState*>(user)->encodedImages;
    if (index < 0 || image->bufferView != -1 || size <= 0)
        return true;
    images.resize(std::max(images.size(), std::size_t(index) + 1));
    images[std::size_t(index)].assign(bytes, bytes + size);
    return true;
}

static std::string firstLine(std::string text) {
    const std::size_t begin = text.find_first_not_of(" \n");
    text = begin == std::string::npos ? "" : text.substr(begin);
    return text.substr(0, text.find('\n')).substr(0, 300);
}

static bool tooDeep(std::string_view text) {
    int depth = 0;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                inString = false;
        } else if (c == '"') {
            inString = true;
        } else if (c == '{' || c == '[') {
            if (++depth > kMaxJsonDepth)
                return true;
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return false;
}

static bool isGlb(const std::vector<unsigned char>& bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

/// The JSON part of the file; of a .glb its first chunk.
static Result<std::string_view> jsonText(const std::vector<unsigned char>& bytes) {
    const char* text = reinterpret_cast<const char*>(bytes.data());
    if (!isGlb(bytes))
        return std::string_view(text, bytes.size());
    if (bytes.size() < 20)
        return fail("GLB header: truncated");
    std::array<std::uint32_t, 5> header;
    std::memcpy(header.data(), bytes.data(), sizeof header);
    if (header[1] != 2)
        return fail(fmt::format("GLB header: version {} is not supported", header[1]));
    if (header[2] > bytes.size())
        return fail(fmt::format("GLB header: length {} exceeds the file's {} bytes", header[2],
                                bytes.size()));
    if (header[4] != 0x4E4F534A)
        return fail("GLB: the first chunk is not JSON");
    if (header[3] > bytes.size() - 20)
        return fail("GLB: the JSON chunk exceeds the file");
    return std::string_view(text + 20, header[3]);
}

static Result<void> checkExtensions(const nlohmann::json& json) {
    for (const nlohmann::json& name : json.value("extensionsRequired", nlohmann::json::array()))
        if (std::ranges::find(kKnownExtensions, name.get<std::string>()) == kKnownExtensions.end())
            return fail(
                fmt::format("extensionsRequired: {} is not supported", name.get<std::string>()));
    // Compressed geometry without the fallback that an extension not required must have.
    constexpr const char* kDraco = "KHR_draco_mesh_compression";
    const nlohmann::json& accessors = json.value("accessors", nlohmann::json::array());
    const nlohmann::json meshes = json.value("meshes", nlohmann::json::array());
    for (std::size_t m = 0; m < meshes.size(); ++m)
        for (const nlohmann::json& primitive : meshes[m]["primitives"])
            if (primitive.value("extensions", nlohmann::json::object()).contains(kDraco))
                for (const auto& [name, index] : primitive["attributes"].items())
                    if (!accessors[index.get<std::size_t>()].contains("bufferView"))
                        return fail(fmt::format("meshes[{}]: {} is not supported", m, kDraco));
    return {};
}

static std::vector<ExternalBuffer> externalBuffers(const nlohmann::json& json) {
    std::vector<ExternalBuffer> external;
    const auto buffers = json.find("buffers");
    for (std::size_t i = 0; buffers != json.end() && i < buffers->size(); ++i) {
        const std::string uri = (*buffers)[i].value("uri", "");
        if (!uri.empty() && !uri.starts_with("data:"))
            external.push_back({i, std::uint64_t((*buffers)[i].value("byteLength", 0.0))});
    }
    return external;
}

/// Parses and checks the JSON by itself, so that errors carry the field.
static Result<nlohmann::json> readJson(std::string_view text) {
    if (text.empty())
        return fail("empty");
    if (tooDeep(text))
        return fail(fmt::format("JSON nested deeper than {}", kMaxJsonDepth));
    nlohmann::json json;
    try {
        json = nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& e) {
        const std::string_view what = e.what();
        return fail(
            fmt::format("JSON: {}", what.substr(std::min(what.find(']') + 2, what.size()))));
    }
    if (const Result<void> valid = checkGltfSchema(json); !valid)
        return tl::make_unexpected(valid.error());
    if (const Result<void> known = checkExtensions(json); !known)
        return tl::make_unexpected(known.error());
    return json;
}

static Result<void> parseModel(const std::vector<unsigned char>& bytes, std::string_view json,
                               LoadState& state, tinygltf::Model& model) {
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks({fileExists, samePath, readWholeFile, nullptr, &state});
    loader.SetImageLoader(keepEncoded, &state);
    std::string error, warning;
    bool loaded = false;
    const std::string folder = state.folder.string();
    try {
        loaded = isGlb(bytes) ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(),
                                                            unsigned(bytes.size()), folder, 0)
                              : loader.LoadASCIIFromString(&model, &error, &warning, json.data(),
                                                           unsigned(json.size()), folder, 0);
    } catch (const std::exception& e) { // libtinygltf 2.7 throws on some malformed files
        return fail(fmt::format("malformed glTF ({})", e.what()));
    }
    if (!loaded && state.filesRead < state.buffers.size() && error.starts_with("File "))
        return fail(fmt::format("buffers[{}].uri: {}", state.buffers[state.filesRead].index,
                                firstLine(error)));
    if (!loaded)
        return fail(error.empty() ? "malformed glTF" : firstLine(error));
    return {};
}

Result<GltfFile> readGltfFile(const std::string& path) {
    std::error_code error;
    if (!fs::exists(path, error))
        return fail("no such file");
    std::vector<unsigned char> bytes;
    if (!readBytes(path, bytes))
        return fail("cannot read");
    if (bytes.size() > std::numeric_limits<std::uint32_t>::max())
        return fail("larger than 4 GiB");
    const Result<std::string_view> text = jsonText(bytes);
    if (!text)
        return tl::make_unexpected(text.error());
    const Result<nlohmann::json> json = readJson(*text);
    if (!json)
        return tl::make_unexpected(json.error());

    GltfFile file;
    LoadState state;
    state.folder = fs::path(path).parent_path();
    state.buffers = externalBuffers(*json);
    if (const Result<void> parsed = parseModel(bytes, *text, state, file.model); !parsed)
        return tl::make_unexpected(parsed.error());
    file.encodedImages = std::move(state.encodedImages);
    file.encodedImages.resize(file.model.images.size());
    file.hash = hashBytes(bytes.data(), bytes.size());
    for (const tinygltf::Buffer& buffer : file.model.buffers)
        file.hash = hashVector(buffer.data, file.hash);
    return file;
}

} // namespace limn
