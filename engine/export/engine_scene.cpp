// SPDX-License-Identifier: MIT
#include "engine/export/engine_scene.h"

#include "engine/export/export_resource.h"
#include "engine/export/exported_lightmap.h"
#include "engine/export/gltf_scene.h"
#include "engine/export/lightmap_file.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace limn {

static void replaceAll(std::string& text, std::string_view what, std::string_view replacement) {
    for (std::size_t position = 0; (position = text.find(what, position)) != std::string::npos;
         position += replacement.size())
        text.replace(position, what.size(), replacement);
}

Result<std::vector<ExportFile>> litScene(const ExportScene& scene, const ExportSettings& settings,
                                         Json extras, const std::string& name,
                                         const Progress& progress) {
    Result<WrittenLightmap> map =
        writtenLightmap(scene, settings, stemOf(name) + "-lightmap", progress);
    if (!map)
        return tl::make_unexpected(map.error());
    GltfOptions options{.pages = &map->pages,
                        .extras = {},
                        .packing = {.quantize = settings.quantize, .meshopt = settings.meshopt}};
    options.extras["lightmap"] = lightmapJson(map->first, settings, map->files);
    if (map->error)
        options.extras["lightmap"]["error"] = errorJson(*map->error);
    if (!extras.isNull())
        options.extras.update(extras);
    Result<std::vector<ExportFile>> files = gltfFiles(scene, options, name, progress);
    if (files)
        std::ranges::move(map->files, std::back_inserter(*files));
    return files;
}

Result<std::vector<ExportFile>> litScene(const ExportScene& scene, const ExportSettings& settings,
                                         Json extras, const Loader& loader, const std::string& name,
                                         const Progress& progress) {
    auto files = litScene(scene, settings, std::move(extras), name, progress);
    const std::string stem = stemOf(name);
    if (files)
        files->push_back(loaderFile(stem + loader.suffix, stem, loader.resources));
    return files;
}

ExportForecast litSceneForecast(const ExportScene& scene, const ExportSettings& settings) {
    ExportForecast f = forecastLightmapOf(scene, settings, PageCount::Any);
    f.bytes += gltfBytes(scene);
    return f;
}

ExportFile loaderFile(const std::string& fileName, std::string stem,
                      std::initializer_list<std::string_view> resources) {
    for (char& c : stem) // it stands in comments, which a line break would end
        c = static_cast<unsigned char>(c) < ' ' ? '_' : c;
    std::string text;
    for (const std::string_view resource : resources)
        text += exportResource(resource);
    replaceAll(text, "ROOM", stem);
    replaceAll(text, "#include \"sh-lightmap.glsl\"", exportResource("sh-lightmap.glsl"));
    return {fileName, std::move(text)};
}

} // namespace limn
