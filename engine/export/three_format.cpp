// SPDX-License-Identifier: MIT
#include "engine/export/engine_formats.h"

#include "engine/core/percent_encoding.h"
#include "engine/export/engine_scene.h"
#include "engine/export/gltf_scene.h"
#include "engine/export/grid_texture.h"

#include <array>
#include <utility>

namespace limn {
namespace three_format {

static constexpr std::array<std::string_view, 1> kExtensions = {".gltf"};
static constexpr std::array<std::string_view, 14> kSettings = {
    "quality",  "texels", "texelsPerMetre", "keepTriangles", "error",   "paths",  "encoding",
    "compress", "direct", "bands",          "quantize",      "meshopt", "detail", "maxSize"};

static constexpr std::uint32_t kReflections = 4;

static ExportSettings ownSettings(ExportSettings settings) {
    settings.quantity = LightmapQuantity::Irradiance;
    if (settings.bands > 1) { // its KTX2Loader reads only the first layer of an array
        settings.encoding = TextureEncoding::Ktx2Half;
        settings.layers = ShLayers::Volume;
    }
    return settings;
}

static Result<std::vector<ExportFile>> write(const ExportScene& scene,
                                             const ExportSettings& settings,
                                             const std::string& name, const Progress& progress) {
    if (ownSettings(settings).encoding == TextureEncoding::Ktx2Bc6h)
        return fail("encoding: the KTX2Loader of three.js reads no BC6H blocks; use half floats or "
                    "shared exponents");
    const std::string stem = stemOf(name);
    const bool hasGrid = !scene.field.grid.empty();
    LitSceneParts parts{.reflections = kReflections};
    if (hasGrid)
        parts.extras["grid"]["uri"] = percentEncoded(stem + "-grid.json");
    Result<std::vector<ExportFile>> files =
        litScene(scene, ownSettings(settings), std::move(parts), name, progress);
    if (!files)
        return files;
    if (hasGrid) {
        Result<std::string> texture = gridKtx2(scene.field, settings.compress);
        if (!texture)
            return tl::make_unexpected(texture.error());
        const std::string textureName = stem + "-grid.ktx2";
        files->push_back({stem + "-grid.json", gridJson(scene, textureName).dump(1) + "\n"});
        files->push_back({textureName, std::move(*texture)});
    }
    files->push_back(
        loaderFile(stem + "-three.js", stem, {"three-grid.js", "ktx2.js", "three.js"}));
    return files;
}

static ExportForecast forecast(const ExportScene& scene, const ExportSettings& settings) {
    ExportForecast f = litSceneForecast(scene, ownSettings(settings), kReflections);
    if (scene.field.cells() > 0)
        f.bytes += gridKtx2Bytes(scene.field);
    return f;
}

} // namespace three_format

constinit const ExportFormat kThreeFormat = {
    .name = "three",
    .label = "three.js",
    .summary = "glTF with a lightmap of irradiance, the grid for what moves, and a module that "
               "loads them into three.js",
    .extensions = three_format::kExtensions,
    .settings = three_format::kSettings,
    .write = three_format::write,
    .forecast = three_format::forecast};

} // namespace limn
