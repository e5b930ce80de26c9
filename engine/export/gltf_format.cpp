// SPDX-License-Identifier: MIT
#include "engine/export/gltf_format.h"

#include "engine/export/engine_scene.h"

#include <array>
#include <utility>

namespace limn {
namespace gltf_format {

static constexpr std::array<std::string_view, 2> kExtensions = {".gltf", ".glb"};
static constexpr std::array<std::string_view, 16> kSettings = {
    "quality",  "texels",   "texelsPerMetre", "keepTriangles", "error", "paths",
    "encoding", "compress", "quantity",       "direct",        "bands", "layers",
    "quantize", "meshopt",  "detail",         "maxSize"};

static Result<std::vector<ExportFile>> write(const ExportScene& scene,
                                             const ExportSettings& settings,
                                             const std::string& name, const Progress& progress) {
    LitSceneParts parts;
    if (settings.encoding == TextureEncoding::Exr)
        parts.panoramas = TextureEncoding::Exr;
    return litScene(scene, settings, std::move(parts), name, progress);
}

static ExportForecast forecast(const ExportScene& scene, const ExportSettings& settings) {
    return litSceneForecast(scene, settings);
}

} // namespace gltf_format

constinit const ExportFormat kGltfFormat = {
    .name = "gltf",
    .label = "glTF with lightmap",
    .summary = "The scene with texture coordinates for its lightmap, and the lightmap beside it. "
               "Lights, cameras and emission use the Khronos extensions. A .glb file holds all "
               "but the lightmap",
    .extensions = gltf_format::kExtensions,
    .settings = gltf_format::kSettings,
    .write = gltf_format::write,
    .forecast = gltf_format::forecast};

} // namespace limn
