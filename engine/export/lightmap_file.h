// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_format.h"
#include "engine/export/lightmap_image.h"

#include <string>

#include <nlohmann/json.hpp>

namespace limn {

/// A lightmap as settings.encoding, compress and layers ask for; `stem` and the encoding's
/// extension are the file's name. Harmonics are encoded as an array or a 3D texture, whatever their
/// number. Fails where the encoding cannot hold the light: harmonics in EXR, negative values with a
/// shared exponent, values above 65504 in half floats or 65408 with a shared exponent.
Result<ExportFile> lightmapFile(const LightmapImage& image, const ExportSettings& settings,
                                const std::string& stem);

/// ".exr" or ".ktx2".
const char* textureExtension(TextureEncoding encoding);

/// What a lightmap means, for asset.extras.limn.lightmap of a glTF file.
nlohmann::ordered_json lightmapJson(const LightmapImage& image, const ExportSettings& settings,
                                    const std::string& fileName);

} // namespace limn
