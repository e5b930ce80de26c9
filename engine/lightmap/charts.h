// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/mesh/mesh.h"

#include <string>

namespace limn {

/// Cuts a mesh into charts: pieces that are flattened into a plane without overlap. Uses TEXCOORD_1
/// if it is valid (within [0, 1], no overlapping or degenerate triangles), with one chart per
/// island; otherwise projects connected triangles along the normal of a seed triangle, as long as
/// they lie within 60 degrees of it. Deterministic. chartUv is to scale in object units. Returns
/// empty charts when cancelled.
MeshCharts buildCharts(const Mesh& mesh, const Progress& progress = {});

/// Why TEXCOORD_1 cannot serve as lightmap coordinates, for the report. Returns an empty string if
/// it is valid and "cancelled" when cancelled.
std::string lightmapUvDefect(const Mesh& mesh, const Progress& progress = {});

} // namespace limn
