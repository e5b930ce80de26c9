// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Area of a triangle in object space [m^2].
float triangleArea(const Mesh& mesh, std::size_t triangle);

/// Unit normal of the counter-clockwise side in object space; +Y for a triangle without area.
glm::vec3 triangleNormal(const Mesh& mesh, std::size_t triangle);

/// A point on a mesh.
struct MeshPoint {
    std::uint32_t triangle;
    glm::vec2 barycentric; ///< (u, v), weights (1-u-v, u, v)

    bool operator==(const MeshPoint&) const = default;
};

/// Point with weights (1-u-v, u, v) in object space.
glm::vec3 trianglePoint(const Mesh& mesh, std::size_t triangle, glm::vec2 uv);

/// Normals and areas of all triangles of a mesh, in their order.
struct TriangleGeometry {
    std::vector<glm::vec3> normal; ///< unit, object space
    std::vector<float> area;       ///< [m^2], object space
};
TriangleGeometry triangleGeometry(const Mesh& mesh);

/// Interpolated vertex normal at (u, v) in world space, unit, used for the cosines of shading. It
/// lies on the side of `geometric`, the unit normal of the triangle's front there. Returns
/// `geometric` if the mesh has no vertex normals or they point to the other side.
glm::vec3 shadingNormal(const Mesh& mesh, const Instance& instance, std::size_t triangle,
                        glm::vec2 uv, glm::vec3 geometric);

/// Area of one side of a triangle in world space [m^2].
float triangleWorldArea(const Scene& scene, const Instance& instance, std::size_t triangle);

/// Total area of one side of the instance's triangles in world space [m^2].
double worldArea(const Scene& scene, const Instance& instance);

/// Bounding box of the instance's positions in world space; kNoBounds if it has none.
Bounds worldBounds(const Scene& scene, const Instance& instance);

} // namespace limn
