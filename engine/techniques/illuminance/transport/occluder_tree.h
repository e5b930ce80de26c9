// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/transport/occluder_cutouts.h"

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// A box of the tree, in breadth-first order: an inner node has count 0 and the children `first`
/// and `first` + 1; a leaf has the triangles [first, first + count).
struct OccluderBox {
    glm::vec3 lower{0};
    std::uint32_t first = 0;
    glm::vec3 upper{0};
    std::uint32_t count = 0;
};
static_assert(sizeof(OccluderBox) == 32);

using OccluderTriangle = std::array<glm::vec3, 3>;
static_assert(sizeof(OccluderTriangle) == 36);

/// Triangles of the static surfaces in world space, in the order of the tree's leaves.
struct OccluderTree {
    std::vector<OccluderBox> boxes;
    std::vector<OccluderTriangle> triangles;
    std::vector<std::uint32_t> cutout; ///< per triangle: its index in cutouts.triangles, or kOpaque
    OccluderCutouts cutouts;
};

/// Maximum number of levels below the root.
inline constexpr std::uint32_t kMaxOccluderDepth = 60;

/// All static triangles with finite corners; those of cutouts with their alpha tests.
OccluderTree occluderTree(const Scene& scene);

/// A tree of boxes over triangles, of which each has a number in `cutout`, split where the surface
/// area heuristic over 16 bins is lowest. Its `cutouts` are empty. Wald. On fast Construction of
/// SAH-based Bounding Volume Hierarchies. 2007
OccluderTree buildOccluderTree(const std::vector<OccluderTriangle>& triangles,
                               const std::vector<std::uint32_t>& cutout);

} // namespace limn
