// SPDX-License-Identifier: MIT
#include "engine/export/engine_formats.h"

#include "engine/export/engine_scene.h"
#include "engine/export/grid_texture.h"

#include <array>
#include <utility>

namespace limn {
namespace babylon_format {

static constexpr std::array<std::string_view, 1> kExtensions = {".gltf"};
static constexpr std::array<std::string_view, 12> kSettings = {
    "quality",  "texels", "texelsPerMetre", "keepTriangles", "error",  "paths",
    "quantity", "direct", "quantize",       "meshopt",       "detail", "maxSize"};

static constexpr std::uint32_t kReflections = 4;

static ExportSettings ownSettings(ExportSettings settings) {
    settings.encoding = TextureEncoding::Ktx2Half;
    settings.compress = false; // its loader reads the file itself
    settings.bands = 1;
    return settings;
}

static Result<std::vector<ExportFile>> write(const ExportScene& scene,
                                             const ExportSettings& settings,
                                             const std::string& name, const Progress& progress) {
    // Babylon.js makes two lights of a node with both extensions, so that it would be twice as
    // bright.
    LitSceneParts parts{.reflections = kReflections, .profiles = false};
    if (!scene.field.grid.empty()) {
        const Sh3 mean = meanProbe(scene.field);
        parts.extras["probe"] = {
            {"leftHanded", shJson(babylonHarmonics(mean, BabylonWorld::LeftHanded))},
            {"rightHanded", shJson(babylonHarmonics(mean, BabylonWorld::RightHanded))}};
    }
    return litScene(scene, ownSettings(settings), std::move(parts),
                    {"-babylon.js", {"ktx2.js", "babylon.js"}}, name, progress);
}

static ExportForecast forecast(const ExportScene& scene, const ExportSettings& settings) {
    return litSceneForecast(scene, ownSettings(settings), kReflections);
}

} // namespace babylon_format

constinit const ExportFormat kBabylonFormat = {
    .name = "babylon",
    .label = "Babylon.js",
    .summary = "glTF with a lightmap, the mean probe for what moves, and a module that loads them "
               "into Babylon.js",
    .extensions = babylon_format::kExtensions,
    .settings = babylon_format::kSettings,
    .write = babylon_format::write,
    .forecast = babylon_format::forecast};

} // namespace limn
