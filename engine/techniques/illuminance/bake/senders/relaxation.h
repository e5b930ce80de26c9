// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/mesh_density.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <vector>

namespace limn {

/// Spreads points of a mesh evenly. Nearby points repel one another and move within the surface,
/// all at once in each of a few rounds. Points that face away (other sheets, the other side of a
/// thin wall) do not repel; borders do, as if the surface were mirrored there. `spacing` is the
/// target distance where the density is 1 [object space], and shrinks with the density's root;
/// nothing moves unless it is > 0 and finite. Each point keeps the target distance of its own place
/// from all others. Turk. Generating Textures on Arbitrary Surfaces Using Reaction-Diffusion. 1991,
/// section 3.1. Deterministic. When cancelled, the points stay as the last rounds left them.
void relax(const Mesh& mesh, float spacing, const MeshDensity& density,
           std::vector<MeshPoint>& points, const Progress& progress = {});

} // namespace limn
