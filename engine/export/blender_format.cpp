// SPDX-License-Identifier: MIT
#include "engine/export/engine_formats.h"

#include "engine/export/engine_scene.h"

#include <array>

namespace limn {
namespace blender_format {

static constexpr std::array<std::string_view, 1> kExtensions = {".gltf"};
static constexpr std::array<std::string_view, 9> kSettings = {
    "quality", "texels", "texelsPerMetre", "keepTriangles", "error",
    "paths",   "direct", "detail",         "maxSize"};

static ExportSettings ownSettings(ExportSettings settings) {
    settings.encoding = TextureEncoding::Exr;
    settings.quantity = LightmapQuantity::Irradiance;
    settings.bands = 1;
    settings.quantize = settings.meshopt = false;
    return settings;
}

static Result<std::vector<ExportFile>> write(const ExportScene& scene,
                                             const ExportSettings& settings,
                                             const std::string& name, const Progress& progress) {
    return litScene(scene, ownSettings(settings), {.panoramas = TextureEncoding::Exr},
                    {"-blender.py", {"blender.py"}}, name, progress);
}

static ExportForecast forecast(const ExportScene& scene, const ExportSettings& settings) {
    return litSceneForecast(scene, ownSettings(settings));
}

} // namespace blender_format

constinit const ExportFormat kBlenderFormat = {
    .name = "blender",
    .label = "Blender",
    .summary = "glTF with a lightmap of irradiance as EXR, and a script that shows it in Blender",
    .extensions = blender_format::kExtensions,
    .settings = blender_format::kSettings,
    .write = blender_format::write,
    .forecast = blender_format::forecast};

} // namespace limn
