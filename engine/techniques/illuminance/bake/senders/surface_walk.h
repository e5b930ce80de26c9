// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Moves points within the surface of a mesh, across the edges that join two triangles.
class SurfaceWalk {
public:
    /// The mesh must outlive the object, which must not be used when cancelled.
    explicit SurfaceWalk(const Mesh& mesh, const Progress& progress = {});

    /// Moves a point straight by `step` (object space, in the plane of the point's triangle),
    /// following the surface across edges. Ends early at a border (see edgePartners()), before a
    /// triangle without area, and after kMaxCrossings edges. The result always lies in its
    /// triangle.
    MeshPoint move(MeshPoint point, glm::vec3 step) const;

    /// Whether edge k of the triangle, from its corner k to the next, is a border.
    bool isBorder(std::uint32_t triangle, std::uint32_t k) const;

    const glm::vec3& normal(std::uint32_t triangle) const { return m_geometry.normal[triangle]; }
    float area(std::uint32_t triangle) const { return m_geometry.area[triangle]; }

private:
    static constexpr int kMaxCrossings = 32;

    const Mesh& m_mesh;
    TriangleGeometry m_geometry;
    std::vector<std::uint32_t> m_partner; ///< per half-edge
};

} // namespace limn
