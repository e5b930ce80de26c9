// SPDX-License-Identifier: MIT
#include "engine/export/engine_formats.h"

#include "engine/export/engine_scene.h"
#include "engine/export/gltf_scene.h"
#include "engine/export/grid_texture.h"

#include <array>

#include <fmt/format.h>

namespace limn {
namespace filament_format {

static constexpr std::array<std::string_view, 1> kExtensions = {".txt"};

/// The text form in which Filament's tools exchange pre-scaled irradiance: a colour a line.
static std::string filamentText(const Sh3& c) {
    constexpr std::array<const char*, 9> kNames = {"L00",  "L1-1", "L10", "L11", "L2-2",
                                                   "L2-1", "L20",  "L21", "L22"};
    const Sh3 e = irradiancePolynomial(c);
    std::string text;
    for (std::size_t i = 0; i < 9; ++i)
        text += fmt::format("({:.9g}, {:.9g}, {:.9g}); // {}, irradiance, pre-scaled base\n",
                            e[i].x, e[i].y, e[i].z, kNames[i]);
    return text;
}

static Result<std::vector<ExportFile>> write(const ExportScene& scene, const ExportSettings&,
                                             const std::string& name, const Progress&) {
    if (const Result<void> exists = checkGrid(scene.field); !exists)
        return tl::make_unexpected(exists.error());
    const std::string stem = stemOf(name);
    return std::vector<ExportFile>{{name, filamentText(meanProbe(scene.field))},
                                   loaderFile(stem + "-filament.js", stem, {"filament.js"})};
}

static ExportForecast forecast(const ExportScene&, const ExportSettings&) {
    return {.bytes = 2048};
}

} // namespace filament_format

constinit const ExportFormat kFilamentFormat = {
    .name = "filament",
    .label = "Filament",
    .summary =
        "The mean light of the grid as the irradiance of an IndirectLight, and a module that "
        "makes one",
    .extensions = filament_format::kExtensions,
    .settings = {},
    .write = filament_format::write,
    .forecast = filament_format::forecast};

} // namespace limn
