// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_format.h"
#include "engine/json/json.h"

#include <string_view>
#include <vector>

namespace limn {

/// What the live page shows before it has the transport.
struct FirstPicture {
    Json description; ///< for scene.json: lights, the sky's mean, how bright it all is, lightmap
    /// The lightmap in the light that the scene begins with: irradiance times the description's
    /// `lightmap.scale`, a word of packRgb9e5() a texel, the upper row first, packed by gzip(). No
    /// file where nothing has a lightmap.
    std::vector<ExportFile> files;
};

/// `transport` is the scene's transport file. Fails as lightmapImage() does.
Result<FirstPicture> firstPicture(const ExportScene& scene, const ExportSettings& settings,
                                  std::string_view transport, const Progress& progress);

} // namespace limn
