// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/scene.h"
#include "shaders/shared/gpu_near.h"

#include <vector>

namespace limn::render {

/// Bounding volume hierarchy of the triangles against which near.frag traces rays: those that
/// findNearSurfaces() of engine/picture/near_light.h may return, without cutouts. Each triangle has
/// the mean albedo of its area.
struct NearGeometry {
    std::vector<shared::GpuNearNode> nodes; ///< the first is the root; empty: no triangles
    std::vector<shared::GpuNearTriangle> triangles;
};

/// Builds the hierarchy of the scene's static triangles with a lightmap. Leaves hold up to four
/// neighbours on a Morton curve, which is fast to build and good enough for short rays.
/// Lauterbach et al. Fast BVH Construction on GPUs. 2009
NearGeometry nearGeometry(const Scene& scene, const LightmapLayout& layout);

} // namespace limn::render
