// SPDX-License-Identifier: MIT
#include "engine/export/engine_formats.h"

#include "engine/export/engine_scene.h"
#include "engine/export/grid_texture.h"

#include <array>
#include <utility>

namespace limn {
namespace playcanvas_format {

static constexpr std::array<std::string_view, 1> kExtensions = {".gltf"};
static constexpr std::array<std::string_view, 9> kSettings = {
    "quality", "texels", "texelsPerMetre", "keepTriangles", "error",
    "paths",   "direct", "detail",         "maxSize"};

static constexpr std::uint32_t kReflections = 4;

static ExportSettings ownSettings(ExportSettings settings) {
    settings.encoding = TextureEncoding::Ktx2Half;
    settings.compress = false; // its loader reads the file itself
    settings.quantity = LightmapQuantity::IrradianceOverPi;
    settings.bands = 1;
    settings.quantize = settings.meshopt = false;
    return settings;
}

static Result<std::vector<ExportFile>> write(const ExportScene& scene,
                                             const ExportSettings& settings,
                                             const std::string& name, const Progress& progress) {
    LitSceneParts parts{.reflections = kReflections};
    if (!scene.field.grid.empty())
        parts.extras["probe"]["ambientSH"] = shJson(playcanvasAmbient(meanProbe(scene.field)));
    return litScene(scene, ownSettings(settings), std::move(parts),
                    {"-playcanvas.js", {"ktx2.js", "playcanvas.js"}}, name, progress);
}

static ExportForecast forecast(const ExportScene& scene, const ExportSettings& settings) {
    return litSceneForecast(scene, ownSettings(settings), kReflections);
}

} // namespace playcanvas_format

constinit const ExportFormat kPlaycanvasFormat = {
    .name = "playcanvas",
    .label = "PlayCanvas",
    .summary = "glTF with a lightmap of irradiance / pi, the mean probe for what moves, and a "
               "module that loads them into PlayCanvas",
    .extensions = playcanvas_format::kExtensions,
    .settings = playcanvas_format::kSettings,
    .write = playcanvas_format::write,
    .forecast = playcanvas_format::forecast};

} // namespace limn
