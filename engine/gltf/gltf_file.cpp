// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_file.h"

#include "engine/core/hash.h"
#include "engine/core/read_file.h"
#include "engine/gltf/data_uri.h"
#include "engine/gltf/gltf_chunks.h"
#include "engine/gltf/gltf_draco.h"
#include "engine/gltf/gltf_extensions.h"
#include "engine/gltf/gltf_meshopt.h"
#include "engine/gltf/gltf_plain.h"
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

/// tinygltf descends recursively into extras.
static constexpr int kMaxJsonDepth = 128;

namespace {

/// State of tinygltf's callbacks.
struct LoadState {
    std::string folder;
    FileReach reach = FileReach::Folder;
    std::uint64_t maxBytes = 0;      ///< of one file
    std::string_view binary;         ///< the chunk of a .glb
    std::vector<GltfSource> sources; ///< in the order in which tinygltf reads them
    std::size_t sourcesRead = 0;
    std::string bufferProblem; ///< why the last buffer could not be read
    std::vector<std::vector<std::uint8_t>> encodedImages;
    std::vector<std::string> imageProblems; ///< as GltfFile
};

} // namespace

/// tinygltf searches for each file in its folder, then in the working directory. The path it asks
/// for is ignored: readSource() finds the bytes independently.
static bool fileExists(const std::string&, void*) {
    return true;
}

static std::string samePath(const std::string& path, void*) {
    return path;
}

static Result<std::string> bytesOf(const LoadState& state, const GltfSource& source) {
    if (!source.problem.empty())
        return fail(source.problem);
    if (source.isBuffer && source.length == 0)
        return std::string(1, '\0');
    if (source.uri.empty())
        return std::string(state.binary);
    if (isDataUri(source.uri))
        return dataOfUri(source.uri);
    const Result<std::string> path = fileOfUri(state.folder, source.uri, state.reach);
    return path ? readFile(*path, state.maxBytes) : path;
}

/// How a message names a buffer's source.
static std::string nameOf(const GltfSource& source) {
    const std::string field = fmt::format("buffers[{}].uri", source.index);
    return source.uri.empty() || isDataUri(source.uri) ? field
                                                       : fmt::format("{}: {}", field, source.uri);
}

static bool readSource(std::vector<unsigned char>* out, std::string* error, const std::string&,
                       void* user) {
    LoadState& state = *static_cast<LoadState*>(user);
    if (state.sourcesRead == state.sources.size())
        return false;
    const GltfSource& source = state.sources[state.sourcesRead++];
    Result<std::string> bytes = bytesOf(state, source);
    std::string problem;
    if (!bytes)
        problem = bytes.error().message;
    else if (bytes->empty())
        problem = "is empty";
    else if (source.isBuffer && bytes->size() < source.length)
        problem = fmt::format("has {} bytes of {}", bytes->size(), source.length);
    if (!problem.empty()) {
        if (source.isBuffer)
            state.bufferProblem = fmt::format("{}: {}", nameOf(source), problem);
        else
            state.imageProblems[source.index] =
                source.problem.empty() ? "cannot be read: " + problem : problem;
        if (error)
            *error = problem;
        return false;
    }
    if (source.isBuffer)
        bytes->resize(std::max<std::size_t>(std::size_t(source.length), 1));
    out->assign(bytes->begin(), bytes->end());
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

static Result<void> checkExtensions(const nlohmann::json& json) {
    for (const nlohmann::json& name : json.value("extensionsRequired", nlohmann::json::array())) {
        const GltfExtension* known = findGltfExtension(name.get<std::string>());
        if (!known || !known->isRead)
            return fail(
                fmt::format("extensionsRequired: {} is not supported", name.get<std::string>()));
    }
    return {};
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

static Result<void> parseModel(const std::string& json, LoadState& state, tinygltf::Model& model) {
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks({fileExists, samePath, readSource, nullptr, &state});
    loader.SetImageLoader(keepEncoded, &state);
    std::string error, warning;
    bool loaded = false;
    try {
        // tinygltf joins names to a folder, but requests no file that it does not find there.
        loaded = loader.LoadASCIIFromString(&model, &error, &warning, json.data(),
                                            unsigned(json.size()), ".", 0);
    } catch (const std::exception& e) { // libtinygltf 2.7 throws on some malformed files
        return fail(fmt::format("malformed glTF ({})", e.what()));
    }
    if (!loaded && !state.bufferProblem.empty())
        return fail(state.bufferProblem);
    if (!loaded)
        return fail(error.empty() ? "malformed glTF" : firstLine(error));
    for (tinygltf::Image& image : model.images)
        image.uri.clear();
    for (const GltfSource& source : state.sources)
        if (!source.isBuffer && !isDataUri(source.uri) && source.index < model.images.size())
            model.images[source.index].uri = source.uri;
    return {};
}

Result<GltfFile> readGltfFile(const std::string& path, FileReach reach,
                              const MemoryBudget& memory) {
    const Result<std::string> main = readFile(path, std::numeric_limits<std::uint32_t>::max());
    if (!main)
        return tl::make_unexpected(main.error());
    const Result<GltfChunks> chunks = splitGltf(*main);
    if (!chunks)
        return tl::make_unexpected(chunks.error());
    if (const Result<void> fits = memory.allow("its JSON", jsonBytes(chunks->json)); !fits)
        return tl::make_unexpected(fits.error());
    Result<nlohmann::json> json = readJson(chunks->json);
    if (!json)
        return tl::make_unexpected(json.error());

    GltfFile file;
    LoadState state;
    state.folder = fs::path(path).parent_path().string();
    state.reach = reach;
    state.maxBytes = memory.maxBytes;
    state.binary = chunks->binary.value_or("");
    state.sources = makePlain(*json, !state.binary.empty());
    const auto images = json->find("images");
    state.imageProblems.resize(images == json->end() ? 0 : images->size());
    if (const Result<void> parsed = parseModel(json->dump(), state, file.model); !parsed)
        return tl::make_unexpected(parsed.error());
    file.encodedImages = std::move(state.encodedImages);
    file.encodedImages.resize(file.model.images.size());
    file.imageProblems = std::move(state.imageProblems);
    file.imageProblems.resize(file.model.images.size());
    file.hash = hashBytes(main->data(), main->size());
    for (const tinygltf::Buffer& buffer : file.model.buffers)
        file.hash = hashVector(buffer.data, file.hash);
    if (const Result<void> unpacked = unpackMeshopt(file.model, memory); !unpacked)
        return tl::make_unexpected(unpacked.error());
    if (const Result<void> unpacked = unpackDraco(file.model, memory); !unpacked)
        return tl::make_unexpected(unpacked.error());
    return file;
}

} // namespace limn
