// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/mesh.h"

#include <cstddef>
#include <cstdint>

namespace limn {

/// Numbers of triangles that removeBadTriangles() removed.
struct RemovedTriangles {
    std::size_t zeroArea = 0;
    std::size_t notFinite = 0; ///< a corner is NaN, infinite or beyond 1e12 m
};

/// Removes triangles that have no usable plane, then vertices that no triangle uses. Precondition:
/// all indices are in range.
RemovedTriangles removeBadTriangles(Mesh& mesh);

/// Gives every triangle the normal of its plane, as glTF requires for files without normals. Splits
/// vertices whose triangles are not coplanar.
void generateFlatNormals(Mesh& mesh);

/// Normalises the normals and replaces those without a direction by the area-weighted mean of the
/// adjacent triangles' normals. Returns the number of normals replaced.
std::size_t mendNormals(Mesh& mesh);

/// Generates a tangent per vertex from the gradient of Mesh::uv(uvSet), orthogonal to the normal.
/// Uses an arbitrary perpendicular direction where there is no gradient.
void generateTangents(Mesh& mesh, std::uint32_t uvSet);

} // namespace limn
