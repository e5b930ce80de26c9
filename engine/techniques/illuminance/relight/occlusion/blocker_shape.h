// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace limn {

/// Shape by which a mesh blocks bounced light, in the object's space: its triangles. Alpha is
/// ignored.
struct BlockerShape {
    /// Side of a convex solid: dot(normal, p) <= offset within it.
    struct Side {
        glm::vec3 normal; ///< unit
        float offset;
        bool there; ///< the mesh's triangles cover all of this side
    };
    static constexpr std::size_t kMaxSides = 16;

    Bounds box;              ///< bounding box of the mesh
    std::vector<Side> sides; ///< of a convex solid that encloses the mesh
    bool closed = false;     ///< all sides are there
    /// Null where the mesh consists of the sides that are there, to a ten-thousandth of its size.
    std::unique_ptr<const TraceScene> triangles;
    /// Radii of balls about the middle of the box: one inside the mesh, or 0 where it is not
    /// closed, and one that encloses it.
    float innerBall = 0, outerBall = 0;
};

/// Computes the shape of a mesh. O(triangles).
BlockerShape blockerShape(const Scene& scene, std::uint32_t mesh);

} // namespace limn
