// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_file.h"

#include "engine/core/hash.h"
#include "engine/core/read_file.h"
#include "engine/gltf/gltf_schema.h"
#include "engine/gltf/gltf_size.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace limn {

namespace fs = std::filesystem;

/// Required extensions that are supported.
static constexpr std::array<std::string_view, 8> kKnownExtensions = {
    "EXT_mesh_gpu_instancing", "KHR_lights_punctual",        "KHR_materials_emissive_strength",
    "KHR_materials_ior",       "KHR_materials_transmission", "KHR_materials_volume",
    "KHR_mesh_quantization",   "KHR_texture_transform"};

/// tinygltf descends recursively into extras.
static constexpr int kMaxJsonDepth = 128;

namespace {

/// A buffer or an image in a file of its own.
struct ExternalFile {
    bool isBuffer = false;
    std::size_t index = 0; ///< in the root's `buffers` or `images`
    std::string uri;
    std::uint64_t length = 0; ///< of a buffer; its file may be longer, which tinygltf would refuse
};

/// State of tinygltf's callbacks.
struct LoadState {
    std::string folder;
    FileReach reach = FileReach::Folder;
    std::uint64_t maxBytes = 0;      ///< of one file
    std::vector<ExternalFile> files; ///< in the order in which tinygltf reads them
    std::size_t filesRead = 0;
    std::string bufferProblem; ///< why the last buffer's file could not be read
    std::vector<std::vector<std::uint8_t>> encodedImages;
    std::vector<std::string> imageProblems; ///< as GltfFile
};

} // namespace

/// tinygltf searches for each file in its folder, then in the working directory. The path it asks
/// for is ignored: readWholeFile() finds the file independently.
static bool fileExists(const std::string&, void*) {
    return true;
}

static std::string samePath(const std::string& path, void*) {
    return path;
}

static bool readWholeFile(std::vector<unsigned char>* out, std::string* error, const std::string&,
                          void* user) {
    LoadState& state = *static_cast<LoadState*>(user);
    if (state.filesRead == state.files.size())
        return false;
    const ExternalFile& file = state.files[state.filesRead++];
    const Result<std::string> path = fileOfUri(state.folder, file.uri, state.reach);
    const Result<std::string> bytes = path ? readFile(*path, state.maxBytes) : path;
    if (!bytes || bytes->empty()) {
        const std::string problem = bytes ? "is empty" : bytes.error().message;
        if (file.isBuffer)
            state.bufferProblem =
                fmt::format("buffers[{}].uri: {}: {}", file.index, file.uri, problem);
        else
            state.imageProblems[file.index] = "cannot be read: " + problem;
        if (error)
            *error = problem;
        return false;
    }
    out->assign(bytes->begin(), bytes->end());
    if (file.isBuffer && out->size() > file.length)
        out->resize(std::size_t(file.length));
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

static bool isGlb(std::string_view bytes) {
    return bytes.starts_with("glTF");
}

/// The JSON text of the file; for a .glb its first chunk.
static Result<std::string_view> jsonText(std::string_view bytes) {
    const std::size_t first = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (!isGlb(bytes) && first != std::string_view::npos && bytes[first] != '{')
        return fail("neither glTF nor GLB");
    if (!isGlb(bytes))
        return bytes;
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
    return bytes.substr(20, header[3]);
}

static Result<void> checkExtensions(const nlohmann::json& json) {
    for (const nlohmann::json& name : json.value("extensionsRequired", nlohmann::json::array()))
        if (std::ranges::find(kKnownExtensions, name.get<std::string>()) == kKnownExtensions.end())
            return fail(
                fmt::format("extensionsRequired: {} is not supported", name.get<std::string>()));
    // Compressed geometry without the fallback that a non-required extension must have.
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

/// External files in the order in which tinygltf reads them: all buffers, then all images.
static std::vector<ExternalFile> externalFiles(const nlohmann::json& json) {
    std::vector<ExternalFile> files;
    for (const char* kind : {"buffers", "images"}) {
        const auto list = json.find(kind);
        for (std::size_t i = 0; list != json.end() && i < list->size(); ++i) {
            const nlohmann::json& one = (*list)[i];
            const std::string uri = one.value("uri", "");
            if (!uri.empty() && !uri.starts_with("data:") && !one.contains("bufferView"))
                files.push_back({kind == std::string_view("buffers"), i, uri,
                                 std::uint64_t(one.value("byteLength", 0.0))});
        }
    }
    return files;
}

/// Parses and checks the JSON before tinygltf does, so that errors name the field.
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

static Result<void> parseModel(std::string_view bytes, std::string_view json, LoadState& state,
                               tinygltf::Model& model) {
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks({fileExists, samePath, readWholeFile, nullptr, &state});
    loader.SetImageLoader(keepEncoded, &state);
    std::string error, warning;
    bool loaded = false;
    // tinygltf joins paths to the folder, but requests no file that it does not find there.
    const std::string folder = state.folder.empty() ? "." : state.folder;
    try {
        loaded =
            isGlb(bytes)
                ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                              reinterpret_cast<const unsigned char*>(bytes.data()),
                                              unsigned(bytes.size()), folder, 0)
                : loader.LoadASCIIFromString(&model, &error, &warning, json.data(),
                                             unsigned(json.size()), folder, 0);
    } catch (const std::exception& e) { // libtinygltf 2.7 throws on some malformed files
        return fail(fmt::format("malformed glTF ({})", e.what()));
    }
    if (!loaded && !state.bufferProblem.empty())
        return fail(state.bufferProblem);
    if (!loaded)
        return fail(error.empty() ? "malformed glTF" : firstLine(error));
    return {};
}

Result<GltfFile> readGltfFile(const std::string& path, FileReach reach,
                              const MemoryBudget& memory) {
    const Result<std::string> main = readFile(path, std::numeric_limits<std::uint32_t>::max());
    if (!main)
        return tl::make_unexpected(main.error());
    const Result<std::string_view> text = jsonText(*main);
    if (!text)
        return tl::make_unexpected(text.error());
    if (const Result<void> fits = memory.allow("its JSON", jsonBytes(*text)); !fits)
        return tl::make_unexpected(fits.error());
    const Result<nlohmann::json> json = readJson(*text);
    if (!json)
        return tl::make_unexpected(json.error());

    GltfFile file;
    LoadState state;
    state.folder = fs::path(path).parent_path().string();
    state.reach = reach;
    state.maxBytes = memory.maxBytes;
    state.files = externalFiles(*json);
    const auto images = json->find("images");
    state.imageProblems.resize(images == json->end() ? 0 : images->size());
    if (const Result<void> parsed = parseModel(*main, *text, state, file.model); !parsed)
        return tl::make_unexpected(parsed.error());
    file.encodedImages = std::move(state.encodedImages);
    file.encodedImages.resize(file.model.images.size());
    file.imageProblems = std::move(state.imageProblems);
    file.imageProblems.resize(file.model.images.size());
    file.hash = hashBytes(main->data(), main->size());
    for (const tinygltf::Buffer& buffer : file.model.buffers)
        file.hash = hashVector(buffer.data, file.hash);
    return file;
}

} // namespace limn
