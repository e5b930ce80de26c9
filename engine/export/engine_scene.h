// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/export/export_format.h"
#include "engine/json/json.h"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace limn {

/// What goes with a lit scene.
struct LitSceneParts {
    Json extras = Json::object();  ///< members of asset.extras.limn
    std::uint32_t reflections = 0; ///< the most panoramas of what metal reflects
    /// Of the sky's panorama and those of reflections: Exr, or half floats without Zstandard.
    TextureEncoding panoramas = TextureEncoding::Ktx2Half;
    bool profiles = true; ///< GltfOptions::profiles
};

/// The scene as glTF with its lightmap beside it, "room-lightmap.ktx2" of "room.gltf", encoded and
/// with the quantity that `settings` ask for, as what engines load, and with the panorama of its
/// sky unless that is black. A lightmap above settings.maxSize becomes several textures.
/// asset.extras.limn describes these files.
Result<std::vector<ExportFile>> litScene(const ExportScene& scene, const ExportSettings& settings,
                                         LitSceneParts parts, const std::string& name,
                                         const Progress& progress);

/// The program that loads an export.
struct Loader {
    const char* suffix;                                ///< of its file's name: "-three.js"
    std::initializer_list<std::string_view> resources; ///< as for loaderFile()
};

/// The same with that program beside it.
Result<std::vector<ExportFile>> litScene(const ExportScene& scene, const ExportSettings& settings,
                                         LitSceneParts parts, const Loader& loader,
                                         const std::string& name, const Progress& progress);

/// About the size of its files, with that many panoramas of reflections.
ExportForecast litSceneForecast(const ExportScene& scene, const ExportSettings& settings,
                                std::uint32_t reflections = 0);

/// A file of the export made of texts in resources/export, one after the other. A text's "ROOM" is
/// replaced by the export's stem, and a line that includes sh-lightmap.glsl by that file.
ExportFile loaderFile(const std::string& fileName, std::string stem,
                      std::initializer_list<std::string_view> resources);

} // namespace limn
