// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/export/exported_lightmap.h"
#include "engine/measure/compare.h"
#include "engine/measure/seams.h"
#include "engine/scene/camera.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// How the error of an exported lightmap is measured.
struct LightmapErrorOptions {
    Camera camera;                          ///< whose picture is compared
    std::uint32_t width = 160, height = 90; ///< of the picture [pixels]
    std::uint32_t pointsPerSide = 2;        ///< points of a pixel along each of its sides
    std::uint32_t paths = 2;                ///< traced from each point, for each of two references
};

/// The value that a program finds in a lightmap at a point of a surface of the exported scene: a
/// bilinear lookup at TEXCOORD_1, and, of harmonics, the irradiance at unit `normal`. std::nullopt
/// where the instance has no lightmap. `cut` is ExportedLightmap::cut.
std::optional<glm::vec3> lookUpExported(const ExportScene& scene, const CutScene* cut,
                                        const LightmapPages& pages,
                                        const std::vector<LightmapImage>& images, SurfaceHit hit,
                                        glm::vec3 normal);

/// Compares what `images` show, one for each page of `map`, with path-traced light, in a picture of
/// the quantity that texels hold. Each pixel is the mean over the points that it sees on surfaces
/// with a lightmap. The two references do not count their own noise as an error. Fails where there
/// is no such point or no light, and when cancelled.
Result<Comparison> lightmapError(const ExportScene& scene, const WrittenLightmap& map,
                                 const std::vector<LightmapImage>& images,
                                 const ExportSettings& settings,
                                 const LightmapErrorOptions& options, const Progress& progress);

/// The jumps of what `images` show where charts meet on the fronts of smooth surfaces. Their unit
/// is that of the texels.
SeamError exportedSeams(const ExportScene& scene, const WrittenLightmap& map,
                        const std::vector<LightmapImage>& images);

} // namespace limn
