// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/export/export_format.h"
#include "engine/lightmap/lightmap_pages.h"
#include "engine/lightmap/plain_lightmap.h"

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Texels of a lightmap, for bilinear lookups at TEXCOORD_1.
struct LightmapImage {
    std::uint32_t width = 0, height = 0;
    std::uint32_t layers = 1; ///< 1, or a coefficient of spherical harmonics in each
    /// rgb[(layer * height + y) * width + x], row 0 at the top, in ExportSettings::quantity; with
    /// several layers radiance coefficients as in IndirectField.
    std::vector<glm::vec3> rgb;
};

/// Fails for settings with a settingsDefect(), if no instance has a lightmap, and where more bands
/// are asked for than the light has.
Result<void> checkLightmap(const ExportScene& scene, const ExportSettings& settings);

/// Bytes of that many texels, encoded as `settings` ask.
std::uint64_t lightmapBytes(std::uint64_t texels, const ExportSettings& settings);

/// Number of texels per cache along each side of a lightmap that has to be a single texture:
/// settings.detail, or the largest odd number below it with which the lightmap stays within
/// settings.maxSize. Fails where no number does, and for settings with a settingsDefect().
Result<std::uint32_t> lightmapDetail(const LightmapLayout& layout, const ExportSettings& settings);

/// The lightmap divided over as many textures as settings.maxSize demands. Its factor is
/// settings.detail, or the largest odd number below it with which every chart stays within
/// settings.maxSize. Fails, with the name of the object, where no number does, and for settings
/// with a settingsDefect().
Result<LightmapPages> exportPages(const ExportScene& scene, const ExportSettings& settings);

/// Evaluates the lightmap of those pages, one image for each. Every texel holds the light at its
/// centre, at the interpolated normal there. Harmonics of two bands have a constant coefficient
/// with which their irradiance at that normal is the one of three. Direct light is the mean of four
/// points of the texel; in harmonics it is limited to their bands. Fails if no instance has a
/// lightmap, where more bands are asked for than the light has, and when cancelled.
Result<std::vector<LightmapImage>> lightmapImages(const ExportScene& scene,
                                                  const ExportSettings& settings,
                                                  const LightmapPages& pages,
                                                  const Progress& progress);

/// The same for a lightmap in a single texture, with lightmapDetail().
Result<LightmapImage> lightmapImage(const ExportScene& scene, const ExportSettings& settings,
                                    const Progress& progress);

/// Width, height and size of the lightmap of lightmapImage(), encoded as `settings` ask, before it
/// is evaluated.
ExportForecast forecastLightmap(const LightmapLayout& layout, const ExportSettings& settings);

/// The same of lightmapImages(), with about the number of pages.
ExportForecast forecastPages(const ExportScene& scene, const ExportSettings& settings);

} // namespace limn
