// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// [m^2] in object space.
float triangleArea(const Mesh& mesh, std::size_t triangle);

/// Unit, of the counter-clockwise side, object space; +Y for a triangle without area.
glm::vec3 triangleNormal(const Mesh& mesh, std::size_t triangle);

/// A point of a mesh.
struct MeshPoint {
    std::uint32_t triangle;
    glm::vec2 barycentric; ///< (u, v), weights (1-u-v, u, v)

    bool operator==(const MeshPoint&) const = default;
};

/// The point of weights (1-u-v, u, v), object space.
glm::vec3 trianglePoint(const Mesh& mesh, std::size_t triangle, glm::vec2 uv);

/// The same for all triangles of a mesh, in their order.
struct TriangleGeometry {
    std::vector<glm::vec3> normal; ///< unit, object space
    std::vector<float> area;       ///< [m^2], object space
};
TriangleGeometry triangleGeometry(const Mesh& mesh);

/// The vertices' normal at (u, v) in the world, unit, on the side of `geometric`, the unit normal
/// of the triangle's front there: what light is weighed by. `geometric` where the vertices have
/// none or theirs points to the other side.
glm::vec3 shadingNormal(const Mesh& mesh, const Instance& instance, std::size_t triangle,
                        glm::vec2 uv, glm::vec3 geometric);

/// Area of one side in the world [m^2].
float triangleWorldArea(const Scene& scene, const Instance& instance, std::size_t triangle);

/// Summed area of one side of the instance's triangles in the world [m^2].
double worldArea(const Scene& scene, const Instance& instance);

} // namespace limn
