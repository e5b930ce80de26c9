// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/export/export_format.h"
#include "engine/json/json.h"

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace limn {

/// The scene as glTF with its lightmap beside it, "room-lightmap.ktx2" of "room.gltf", encoded and
/// with the quantity that `settings` ask for, as what engines load. A lightmap above
/// settings.maxSize becomes several textures. asset.extras.limn describes the lightmap and holds
/// the members of `extras`.
Result<std::vector<ExportFile>> litScene(const ExportScene& scene, const ExportSettings& settings,
                                         Json extras, const std::string& name,
                                         const Progress& progress);

/// The program that loads an export.
struct Loader {
    const char* suffix;                                ///< of its file's name: "-three.js"
    std::initializer_list<std::string_view> resources; ///< as for loaderFile()
};

/// The same with that program beside it.
Result<std::vector<ExportFile>> litScene(const ExportScene& scene, const ExportSettings& settings,
                                         Json extras, const Loader& loader, const std::string& name,
                                         const Progress& progress);

/// About the size of its files.
ExportForecast litSceneForecast(const ExportScene& scene, const ExportSettings& settings);

/// A file of the export made of texts in resources/export, one after the other. A text's "ROOM" is
/// replaced by the export's stem, and a line that includes sh-lightmap.glsl by that file.
ExportFile loaderFile(const std::string& fileName, std::string stem,
                      std::initializer_list<std::string_view> resources);

} // namespace limn
