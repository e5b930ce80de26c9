// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_format.h"
#include "engine/export/lightmap_image.h"
#include "engine/json/json.h"

#include <string>
#include <string_view>
#include <vector>

namespace limn {

/// Fails where an encoding cannot hold so many layers.
Result<void> checkEncoding(const ExportSettings& settings, std::uint32_t layers);

/// A lightmap as settings.encoding, compress and layers ask for; `stem` and the encoding's
/// extension are the file's name. Harmonics are encoded as an array or a 3D texture, whatever their
/// number. Fails where the encoding cannot hold the light: harmonics in EXR, negative values with a
/// shared exponent, values above 65504 in half floats or 65408 with a shared exponent.
Result<ExportFile> lightmapFile(const LightmapImage& image, const ExportSettings& settings,
                                const std::string& stem);

/// The same for every page of a lightmap: "room.exr", "room-2.exr", and so on.
Result<std::vector<ExportFile>> lightmapFiles(const std::vector<LightmapImage>& pages,
                                              const ExportSettings& settings,
                                              const std::string& stem);

/// ".exr" or ".ktx2".
const char* textureExtension(TextureEncoding encoding);

/// The encoding of textures beside or in the main file `name`: half floats where it is a KTX2 file
/// and the settings do not ask for KTX2.
TextureEncoding encodingFor(const ExportSettings& settings, std::string_view name);

/// What a lightmap means, for asset.extras.limn.lightmap of a glTF file. `image` is any of its
/// pages and `files` are those of all. One file is its `uri`; several are `uris`, of which a
/// material's extras.limn.lightmapPage chooses one, the first where it has none.
Json lightmapJson(const LightmapImage& image, const ExportSettings& settings,
                  const std::vector<ExportFile>& files);

/// The error of a lightmap, for the same place: nRMSE and bias, each with its standard error.
Json errorJson(const Comparison& error);

/// Its seams, there too: the mean jump relative to the light, and the length of all seams [m].
Json seamsJson(const SeamError& seams);

} // namespace limn
