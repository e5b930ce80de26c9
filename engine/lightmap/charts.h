// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/lightmap_layout.h"
#include "engine/scene/mesh/mesh.h"

#include <string>

namespace limn {

/// Cuts a mesh into charts: pieces that lie flat, without overlap, in a plane. Uses TEXCOORD_1
/// where it is valid (within [0, 1], no two triangles overlapping, no degenerate ones), one chart
/// per island; else projects connected triangles along the normal of a seed, within 60 degrees of
/// it. Deterministic. chartUv is in object units, to scale.
/// Empty when cancelled.
MeshCharts buildCharts(const Mesh& mesh, const Progress& progress = {});

/// Whether TEXCOORD_1 can serve as lightmap coordinates; else why not, for the report. Empty:
/// valid. "cancelled" when cancelled.
std::string lightmapUvDefect(const Mesh& mesh, const Progress& progress = {});

} // namespace limn
