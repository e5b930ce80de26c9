// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/mesh/mesh.h"

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// Cuts a mesh into charts: pieces that are flattened into a plane without overlap. Uses TEXCOORD_1
/// if it is valid (within [0, 1], no overlapping or degenerate triangles), with one chart per
/// island; otherwise projects connected triangles along the normal of a seed triangle, as long as
/// they lie within 60 degrees of it. Deterministic. chartUv is to scale in object units. Returns
/// empty charts when cancelled.
MeshCharts buildCharts(const Mesh& mesh, const Progress& progress = {});

/// Charts of a mesh, from the chart of each triangle and the position of each corner in the plane
/// of its chart [object units]: one vertex for each chart that a mesh's vertex belongs to, and
/// lower corners of charts at 0.
MeshCharts splitIntoCharts(const Mesh& mesh, std::vector<std::uint32_t> chartOfTriangle,
                           const std::vector<glm::vec2>& corner);

/// Why TEXCOORD_1 cannot serve as lightmap coordinates, for the report. Returns an empty string if
/// it is valid and "cancelled" when cancelled.
std::string lightmapUvDefect(const Mesh& mesh, const Progress& progress = {});

} // namespace limn
