// SPDX-License-Identifier: MIT
#include "engine/export/engine_scene.h"

#include "engine/export/export_resource.h"
#include "engine/export/exported_lightmap.h"
#include "engine/export/gltf_scene.h"
#include "engine/export/lightmap_file.h"
#include "engine/export/surroundings.h"

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
                                         LitSceneParts parts, const std::string& name,
                                         const Progress& progress) {
    const std::string stem = stemOf(name);
    Result<WrittenLightmap> map = writtenLightmap(scene, settings, stem + "-lightmap", progress);
    if (!map)
        return tl::make_unexpected(map.error());
    Result<Surroundings> around =
        surroundings(scene, parts.reflections, parts.panoramas, stem, progress);
    if (!around)
        return tl::make_unexpected(around.error());
    GltfOptions options{.pages = &map->pages,
                        .cut = map->cut.get(),
                        .extras = std::move(around->json),
                        .packing = {.quantize = settings.quantize, .meshopt = settings.meshopt},
                        .reflections = std::move(around->ofInstance),
                        .profiles = parts.profiles};
    options.extras["lightmap"] = lightmapJson(map->first, settings, map->files);
    if (map->error)
        options.extras["lightmap"]["error"] = errorJson(*map->error);
    if (map->seams)
        options.extras["lightmap"]["seams"] = seamsJson(*map->seams);
    options.extras.update(parts.extras);
    Result<std::vector<ExportFile>> files = gltfFiles(scene, options, name, progress);
    if (files) {
        std::ranges::move(map->files, std::back_inserter(*files));
        std::ranges::move(around->files, std::back_inserter(*files));
    }
    return files;
}

Result<std::vector<ExportFile>> litScene(const ExportScene& scene, const ExportSettings& settings,
                                         LitSceneParts parts, const Loader& loader,
                                         const std::string& name, const Progress& progress) {
    auto files = litScene(scene, settings, std::move(parts), name, progress);
    const std::string stem = stemOf(name);
    if (files)
        files->push_back(loaderFile(stem + loader.suffix, stem, loader.resources));
    return files;
}

ExportForecast litSceneForecast(const ExportScene& scene, const ExportSettings& settings,
                                std::uint32_t reflections) {
    ExportForecast f = forecastLightmapOf(scene, settings, PageCount::Any);
    f.bytes += gltfBytes(scene, {.quantize = settings.quantize, .meshopt = settings.meshopt}) +
               surroundingsBytes(scene, reflections);
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
