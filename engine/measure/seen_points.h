// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/field/indirect_field.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/reference/path.h"
#include "engine/shading/pixel_rays.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace limn {

/// A point that a pixel sees, where light from paths and light from a field can be compared.
struct SeenPoint {
    Hit hit;
    SurfacePoint surface;
};

/// A random point of pixel y * width + x; std::nullopt where it sees no surface, or the back of a
/// one-sided one.
std::optional<SeenPoint> findSeenPoint(const TraceScene& trace, const PixelRays& rays,
                                       std::uint32_t pixel, std::uint32_t seed);

/// One random point of each pixel that sees a surface; backs of one-sided surfaces are left out.
std::vector<SeenPoint> findSeenPoints(const TraceScene& trace, const Camera& camera,
                                      std::uint32_t width, std::uint32_t height,
                                      std::uint32_t seed);

/// Path-traced irradiance of each point, without direct light [W m^-2]: the mean of `paths`
/// paths. Returns std::nullopt when cancelled.
std::optional<std::vector<glm::vec3>> traceIrradiance(const PathContext& context,
                                                      const std::vector<SeenPoint>& points,
                                                      std::uint32_t paths, std::uint32_t seed,
                                                      const Progress& progress = {});

/// Irradiance of the same points, looked up in a field. `layout` belongs to the field.
std::vector<glm::vec3> lookUpIrradiance(const IndirectField& field, const LightmapLayout& layout,
                                        const Scene& scene, const std::vector<SeenPoint>& points);

} // namespace limn
