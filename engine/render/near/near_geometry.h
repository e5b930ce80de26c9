// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/lightmap_layout.h"
#include "engine/scene/scene.h"
#include "shaders/shared/gpu_near.h"

#include <vector>

namespace limn::render {

/// Surfaces that near.frag finds with rays: those that nearCorrection() of
/// engine/measure/near_light.h exchanges light with, but for cutouts, which are left out. The
/// albedo of a triangle is its mean.
struct NearGeometry {
    std::vector<shared::GpuNearNode> nodes; ///< empty: there are no such surfaces
    std::vector<shared::GpuNearTriangle> triangles;
};

/// Builds a tree of the static triangles with a lightmap. Its leaves hold up to four triangles that
/// are neighbours on a Morton curve, which is fast to build and good enough for short rays
/// (Lauterbach et al. Fast BVH Construction on GPUs. 2009).
NearGeometry nearGeometry(const Scene& scene, const LightmapLayout& layout);

} // namespace limn::render
