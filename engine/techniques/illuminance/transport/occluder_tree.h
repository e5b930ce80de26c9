// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

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
};

/// Maximum number of levels below the root.
inline constexpr std::uint32_t kMaxOccluderDepth = 60;

/// All static triangles with finite corners. Those of cutouts are divided up to five times into
/// quarters, until an edge is shorter than 1/2048 of the scene, and the pieces whose middle is a
/// hole are left out.
OccluderTree occluderTree(const Scene& scene);

/// A tree of boxes over triangles, split where the surface area heuristic over 16 bins is lowest.
/// Wald. On fast Construction of SAH-based Bounding Volume Hierarchies. 2007
OccluderTree buildOccluderTree(std::vector<OccluderTriangle> triangles);

} // namespace limn
