// SPDX-License-Identifier: MIT
#include "engine/export/lightmap_format.h"

#include "engine/export/lightmap_image.h"
#include "engine/files/image_file.h"

#include <array>

namespace limn {

static constexpr std::array<std::string_view, 1> kExtensions = {".exr"};
static constexpr std::array<std::string_view, 4> kSettings = {"quantity", "direct", "detail",
                                                              "maxSize"};

static Result<std::vector<ExportFile>> write(const ExportScene& scene,
                                             const ExportSettings& settings,
                                             const std::string& name, const Progress& progress) {
    const Result<LightmapImage> image = lightmapImage(scene, settings, progress);
    if (!image)
        return tl::make_unexpected(image.error());
    Result<std::string> bytes = encodeExr({image->width, image->height, image->rgb});
    if (!bytes)
        return tl::make_unexpected(bytes.error());
    return std::vector<ExportFile>{{name, std::move(*bytes)}};
}

static ExportForecast forecast(const ExportScene& scene, const ExportSettings& settings) {
    return forecastLightmap(scene.layout, settings);
}

constinit const ExportFormat kLightmapFormat = {
    .name = "lightmap",
    .label = "Lightmap",
    .summary = "A texture of irradiance for the texture coordinates that the glTF export writes",
    .extensions = kExtensions,
    .settings = kSettings,
    .write = write,
    .forecast = forecast};

} // namespace limn
