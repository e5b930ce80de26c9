// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/bounds.h"
#include "engine/scene/mesh/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// A regular raster of cubes in object space. Cube (0, 0, 0) has its lower corner at the origin.
struct CubeRaster {
    float edge = 1; ///< > 0

    glm::ivec3 cubeOf(glm::vec3 p) const;
};

/// A number of a cube; numbers of different cubes differ within 2^20 cubes of the origin.
std::uint64_t cubeKey(glm::ivec3 cube);

/// What lies of one side of a triangle in one cube.
struct CubePiece {
    glm::ivec3 cube{0};
    std::uint32_t triangle = 0;
    bool back = false;   ///< of the triangle's back
    glm::vec3 middle{0}; ///< centroid
    glm::vec3 normal{0}; ///< unit, of that side
    float area = 0;      ///< > 0
    Bounds bounds;
};

/// Clips the triangles of a mesh to cubes. The pieces are ordered by cube, then by triangle; with
/// `twoSided` there are those of both sides. Triangles without area have none.
std::vector<CubePiece> cutIntoCubes(const Mesh& mesh, const CubeRaster& raster, bool twoSided);

/// Directions into whose bins normals are sorted: those to the middles of the faces, edges and
/// corners of a cube. A direction lies within 27.6 degrees of the middle of its bin.
inline constexpr std::uint32_t kNormalBins = 26;
std::uint32_t normalBin(glm::vec3 normal);

/// Point of a triangle nearest to `p`.
struct TrianglePoint {
    glm::vec3 position{0};
    float u = 0, v = 0; ///< barycentrics, weights (1-u-v, u, v)
};
/// Ericson. Real-Time Collision Detection. 2005, section 5.1.5
TrianglePoint nearestOnTriangle(glm::vec3 p, glm::vec3 a, glm::vec3 b, glm::vec3 c);

} // namespace limn
