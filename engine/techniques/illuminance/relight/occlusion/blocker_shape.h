// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace limn {

/// What of a mesh keeps bounced light off, in the object's space: its triangles; alpha is not
/// asked.
struct BlockerShape {
    /// Of a convex solid: dot(normal, p) <= offset within.
    struct Side {
        glm::vec3 normal; ///< unit
        float offset;
        bool there; ///< the mesh has triangles there, all over it
    };
    static constexpr std::size_t kMaxSides = 16;

    Bounds box;              ///< about the mesh
    std::vector<Side> sides; ///< of a convex solid about the mesh
    bool closed = false;     ///< all sides are there
    /// Null: the mesh is those of the sides that are there, to a ten-thousandth of its size.
    std::unique_ptr<const TraceScene> triangles;
    /// Radii of balls about the middle of the box: within the mesh, which is closed, or 0; and
    /// around it.
    float innerBall = 0, outerBall = 0;
};

/// O(triangles).
BlockerShape blockerShape(const Scene& scene, std::uint32_t mesh);

} // namespace limn
