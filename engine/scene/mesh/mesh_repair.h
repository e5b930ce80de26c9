// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/mesh.h"

#include <cstddef>

namespace limn {

/// What removeBadTriangles took away.
struct RemovedTriangles {
    std::size_t zeroArea = 0;
    std::size_t notFinite = 0; ///< a corner is NaN, infinite or beyond 1e12 m
};

/// Drops triangles that have no usable plane, then vertices that no triangle names. Needs indices
/// in range.
RemovedTriangles removeBadTriangles(Mesh& mesh);

/// Gives every triangle its own plane's normal, as glTF asks where a file has none. Splits vertices
/// whose triangles are not coplanar.
void generateFlatNormals(Mesh& mesh);

/// Normalises; replaces normals without direction by the area-weighted mean of their triangles'.
/// Returns how many were replaced.
std::size_t mendNormals(Mesh& mesh);

/// Per vertex, from the gradient of uv0 (uv1 where that is missing), orthogonal to the normal. Any
/// perpendicular direction where there is no gradient.
void generateTangents(Mesh& mesh, bool fromUv1);

} // namespace limn
