// SPDX-License-Identifier: MIT
#include "engine/export/web_format.h"

#include "engine/core/read_file.h"
#include "engine/export/export_resource.h"
#include "engine/export/gltf_scene.h"
#include "engine/export/limnrt_format.h"
#include "engine/export/packed_transport.h"
#include "engine/export/web_description.h"
#include "engine/json/json.h"

#include <array>
#include <filesystem>

#include <fmt/format.h>

namespace limn {

namespace web_format {
namespace {

constexpr std::array<std::string_view, 2> kSettings = {"detail", "maxSize"};
constexpr std::array kPages = {"index.html",    "expand.js",     "fineness.js",    "handles.js",
                               "kept_light.js", "lamp_light.js", "lamp_panel.js",  "lamps.js",
                               "lightmap.js",   "live_light.js", "live_worker.js", "page.js",
                               "panel.js",      "progress.js",   "shadow_maps.js", "transport.js",
                               "view_scene.js"};

/// A file of the npm package three, and its place in the page's folder.
struct ThreeFile {
    const char *source, *target;
};
constexpr std::array<ThreeFile, 8> kThree = {
    {{"build/three.core.js", "three/three.core.js"},
     {"build/three.module.js", "three/three.module.js"},
     {"examples/jsm/controls/OrbitControls.js", "three/addons/controls/OrbitControls.js"},
     {"examples/jsm/lights/RectAreaLightTexturesLib.js",
      "three/addons/lights/RectAreaLightTexturesLib.js"},
     {"examples/jsm/lights/RectAreaLightUniformsLib.js",
      "three/addons/lights/RectAreaLightUniformsLib.js"},
     {"examples/jsm/loaders/GLTFLoader.js", "three/addons/loaders/GLTFLoader.js"},
     {"examples/jsm/utils/BufferGeometryUtils.js", "three/addons/utils/BufferGeometryUtils.js"},
     {"examples/jsm/utils/SkeletonUtils.js", "three/addons/utils/SkeletonUtils.js"}}};
constexpr std::uint64_t kThreeBytes = 2'700'000, kMaxFile = 64 << 20;

constexpr const char* kRuntime = "limn_runtime.wasm";

/// Adds a file of another folder.
Result<void> addCopy(std::vector<ExportFile>& files, const std::string& folder,
                     const std::string& source, const std::string& target, const char* advice) {
    const std::string path = (std::filesystem::path(folder) / source).string();
    Result<std::string> bytes = readFile(path, kMaxFile);
    if (!bytes)
        return fail(fmt::format("{}: {}; {}", path, bytes.error().message, advice));
    files.push_back({target, std::move(*bytes)});
    return {};
}

Result<void> addPrograms(std::vector<ExportFile>& files, const ExportFolders& folders) {
    for (const char* page : kPages)
        files.push_back({page, std::string(exportResource(std::string("web/") + page))});
    if (const Result<void> added = addCopy(files, folders.webRuntime, kRuntime, kRuntime,
                                           "./run --web builds the runtime for the web");
        !added)
        return added;
    for (const ThreeFile& file : kThree)
        if (const Result<void> added =
                addCopy(files, folders.three, file.source, file.target,
                        "npm install three, or --three with the folder of that package");
            !added)
            return added;
    return {};
}

Result<std::vector<ExportFile>> write(const ExportScene& scene, const ExportSettings& settings,
                                      const std::string& name, const Progress& progress) {
    std::vector<ExportFile> files; // the page comes first, and is written last
    if (const Result<void> added = addPrograms(files, scene.folders); !added)
        return tl::make_unexpected(added.error());
    const Result<std::string> transport = transportBytes(scene, settings, progress, true);
    if (!transport)
        return tl::make_unexpected(transport.error());
    Result<FirstPicture> first = firstPicture(scene, settings, *transport, progress);
    if (!first)
        return tl::make_unexpected(first.error());
    Result<std::string> packed = packTransport(*transport);
    if (!packed)
        return tl::make_unexpected(packed.error());
    const LightmapPages page = onePage(scene.scene, scene.layout, 1);
    Result<std::vector<ExportFile>> gltf =
        gltfFiles(scene, {.pages = &page, .extras = {}}, "scene.gltf", progress);
    if (!gltf)
        return gltf;
    Json description = {{"title", name},
                        {"scene", "scene.gltf"},
                        {"transport", "scene.limnpack"},
                        {"transportBytes", packed->size()}};
    description.update(first->description);
    files.push_back({"scene.json", description.dump(1) + "\n"});
    files.push_back({"scene.limnpack", std::move(*packed)});
    for (ExportFile& file : first->files)
        files.push_back(std::move(file));
    for (ExportFile& file : *gltf)
        files.push_back(std::move(file));
    return files;
}

ExportForecast forecast(const ExportScene& scene, const ExportSettings& settings) {
    constexpr std::uint64_t kPacked = 3; // packed transport is about a third
    ExportForecast f = forecastTransport(scene, settings);
    f.bytes =
        f.bytes / kPacked + kThreeBytes + gltfBytes(scene) + std::uint64_t(f.width) * f.height * 3;
    return f;
}

} // namespace
} // namespace web_format

constinit const ExportFormat kWebFormat = {
    .name = "web",
    .label = "Live web page",
    .summary = "A folder for any web server: a page on which visitors move lamps and change "
               "colours and sky, and bounced light follows",
    .extensions = {},
    .settings = web_format::kSettings,
    .write = web_format::write,
    .forecast = web_format::forecast};

} // namespace limn
