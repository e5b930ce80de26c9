// SPDX-License-Identifier: MIT
#include "engine/export/gltf_format.h"

#include "engine/export/gltf_scene.h"
#include "engine/export/lightmap_image.h"
#include "engine/files/image_file.h"

#include <array>

namespace limn {

using Json = nlohmann::ordered_json;

namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".gltf"};
constexpr std::array<std::string_view, 4> kSettings = {"quantity", "direct", "detail", "maxSize"};

/// What the lightmap beside the file means, for asset.extras.limn.lightmap.
Json lightmapExtras(const LightmapImage& image, const ExportSettings& settings,
                    const std::string& file) {
    constexpr std::array<const char*, 3> kUnits = {"W m^-2", "W m^-2 sr^-1", "W m^-2 sr^-1"};
    constexpr std::array<const char*, 3> kEquations = {"L = albedo / pi * texel",
                                                       "L = albedo * texel", "L = texel"};
    const auto quantity = std::size_t(settings.quantity);
    return {{"uri", uriOf(file)},
            {"texCoord", 1},
            {"width", image.width},
            {"height", image.height},
            {"firstRow", "top"},
            {"colors", "linear Rec. 709"},
            {"quantity", kLightmapQuantityNames[quantity]},
            {"unit", kUnits[quantity]},
            {"outgoingRadiance", kEquations[quantity]},
            {"includesDirectLight", settings.direct}};
}

Result<std::vector<ExportFile>> write(const ExportScene& scene, const ExportSettings& settings,
                                      const std::string& name, const Progress& progress) {
    const Result<LightmapImage> image = lightmapImage(scene, settings, progress);
    if (!image)
        return tl::make_unexpected(image.error());
    Result<std::string> exr = encodeExr({image->width, image->height, image->rgb});
    if (!exr)
        return tl::make_unexpected(exr.error());
    const std::string file = stemOf(name) + "-lightmap.exr";
    GltfOptions options;
    options.extras["lightmap"] = lightmapExtras(*image, settings, file);
    Result<std::vector<ExportFile>> files = gltfFiles(scene, options, name, progress);
    if (files)
        files->push_back({file, std::move(*exr)});
    return files;
}

ExportForecast forecast(const ExportScene& scene, const ExportSettings& settings) {
    ExportForecast f = forecastLightmap(scene.layout, settings);
    f.bytes += gltfBytes(scene);
    return f;
}

} // namespace

constinit const ExportFormat kGltfFormat = {
    .name = "gltf",
    .label = "glTF with lightmap",
    .summary = "The scene with texture coordinates for its lightmap, and the lightmap beside it. "
               "Lights, cameras and emission use the Khronos extensions",
    .extensions = kExtensions,
    .settings = kSettings,
    .write = write,
    .forecast = forecast};

} // namespace limn
