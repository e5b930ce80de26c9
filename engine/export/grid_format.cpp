// SPDX-License-Identifier: MIT
#include "engine/export/engine_formats.h"

#include "engine/export/engine_scene.h"
#include "engine/export/gltf_scene.h"
#include "engine/export/grid_texture.h"

#include <array>

namespace limn {
namespace grid_format {

static constexpr std::array<std::string_view, 1> kExtensions = {".json"};
static constexpr std::array<std::string_view, 1> kSettings = {"compress"};

static Result<std::vector<ExportFile>> write(const ExportScene& scene,
                                             const ExportSettings& settings,
                                             const std::string& name, const Progress& progress) {
    progress.at("grid", 0);
    Result<std::string> texture = gridKtx2(scene.field, settings.compress);
    if (!texture)
        return tl::make_unexpected(texture.error());
    const std::string stem = stemOf(name), textureName = stem + ".ktx2";
    return std::vector<ExportFile>{{name, gridJson(scene, textureName).dump(1) + "\n"},
                                   {textureName, std::move(*texture)},
                                   loaderFile(stem + "-three.js", stem, {"three-grid.js"})};
}

static ExportForecast forecast(const ExportScene& scene, const ExportSettings&) {
    return {.bytes = gridKtx2Bytes(scene.field)};
}

} // namespace grid_format

constinit const ExportFormat kGridFormat = {
    .name = "grid",
    .label = "Grid of probes",
    .summary = "The light in the air: a 3D texture of spherical harmonics, a JSON file that "
               "describes it, and a loader for three.js",
    .extensions = grid_format::kExtensions,
    .settings = grid_format::kSettings,
    .write = grid_format::write,
    .forecast = grid_format::forecast};

} // namespace limn
