// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/export/export_format.h"
#include "engine/export/lightmap_image.h"
#include "engine/final_lightmap/cut_scene.h"
#include "engine/lightmap/lightmap_pages.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace limn {

/// A lightmap as it is exported: where charts lie on its pages, and one image for each page.
struct ExportedLightmap {
    /// The scene whose vertices it belongs to; null: the exported one.
    std::shared_ptr<const CutScene> cut;
    LightmapPages pages;
    std::vector<LightmapImage> images;
};

/// How many textures a lightmap may have.
enum class PageCount : std::uint8_t { One, Any };

/// The lightmap that settings.quality asks for. A final one is gathered at texels of its own
/// (engine/final_lightmap); a draft is that of lightmapImages(). Fails as lightmapImages() and
/// exportPages() do.
Result<ExportedLightmap> exportedLightmap(const ExportScene& scene, const ExportSettings& settings,
                                          PageCount pageCount, const Progress& progress);

/// The files of such a lightmap, and its error where that is measured.
struct WrittenLightmap {
    std::shared_ptr<const CutScene> cut; ///< as ExportedLightmap::cut
    LightmapPages pages;
    LightmapImage first; ///< image of the first page without its texels, for lightmapJson()
    std::vector<ExportFile> files;
    std::optional<Comparison> error; ///< of the texels that a program reads from the files
    std::optional<SeamError> seams;  ///< of the same; none where no charts meet on smooth surfaces
};

/// Makes the lightmap and encodes it in files that are called `stem`. Where settings.error asks for
/// it, the texels of a final lightmap double until its error holds. Fails as exportedLightmap(),
/// lightmapFiles() and lightmapError() do, and where the error does not hold.
Result<WrittenLightmap> writtenLightmap(const ExportScene& scene, const ExportSettings& settings,
                                        const std::string& stem, const Progress& progress);

/// Its size before it is made.
ExportForecast forecastLightmapOf(const ExportScene& scene, const ExportSettings& settings,
                                  PageCount pageCount);

} // namespace limn
