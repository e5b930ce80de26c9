// SPDX-License-Identifier: MIT
#include "engine/export/lightmap_format.h"

#include "engine/export/exported_lightmap.h"
#include "engine/export/gltf_scene.h"
#include "engine/export/lightmap_file.h"
#include "engine/scene/export_settings_fields.h"

#include <array>

#include <fmt/format.h>

namespace limn {
namespace lightmap_format {

static constexpr std::array<std::string_view, 2> kExtensions = {".exr", ".ktx2"};
static constexpr std::array<std::string_view, 13> kSettings = {
    "quality",  "texels", "texelsPerMetre", "error",  "paths",  "encoding", "compress",
    "quantity", "direct", "bands",          "layers", "detail", "maxSize"};

/// The settings with the encoding that the file's extension asks for.
static Result<ExportSettings> settingsFor(ExportSettings settings, const std::string& name) {
    settings.encoding = encodingFor(settings, name);
    if (!name.ends_with(textureExtension(settings.encoding)))
        return fail(fmt::format("encoding: {} is written to {} files",
                                kTextureEncodingNames[std::size_t(settings.encoding)],
                                textureExtension(settings.encoding)));
    settings.keepTriangles = true; // there is no mesh in the file that could have others
    return settings;
}

static Result<std::vector<ExportFile>> write(const ExportScene& scene, const ExportSettings& wanted,
                                             const std::string& name, const Progress& progress) {
    const Result<ExportSettings> settings = settingsFor(wanted, name);
    if (!settings)
        return tl::make_unexpected(settings.error());
    Result<WrittenLightmap> map = writtenLightmap(scene, *settings, stemOf(name), progress);
    if (!map)
        return tl::make_unexpected(map.error());
    return std::move(map->files);
}

static ExportForecast forecast(const ExportScene& scene, const ExportSettings& settings) {
    return forecastLightmapOf(scene, settings, PageCount::Any);
}

} // namespace lightmap_format

constinit const ExportFormat kLightmapFormat = {
    .name = "lightmap",
    .label = "Lightmap",
    .summary = "A texture of irradiance, or of spherical harmonics, for the texture coordinates "
               "that the glTF export writes",
    .extensions = lightmap_format::kExtensions,
    .settings = lightmap_format::kSettings,
    .write = lightmap_format::write,
    .forecast = lightmap_format::forecast};

} // namespace limn
