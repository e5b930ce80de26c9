// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/mesh_density.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <vector>

namespace limn {

/// Spreads points of a mesh evenly: repulsion from those near, moving within the surface only, all
/// at once in each of a few rounds. Points that face away (other sheets, the other side of a thin
/// wall) do not repel; borders do, as if the surface were mirrored there. `spacing` is the distance
/// wanted where the density is 1 [object space], and shrinks with its root; nothing moves unless it
/// is > 0 and finite. Each point keeps the distance of its own place from all others. Turk.
/// Generating Textures on Arbitrary Surfaces Using Reaction-Diffusion. 1991, section 3.1.
/// Deterministic. When cancelled, what it reached.
void relax(const Mesh& mesh, float spacing, const MeshDensity& density,
           std::vector<MeshPoint>& points, const Progress& progress = {});

} // namespace limn
