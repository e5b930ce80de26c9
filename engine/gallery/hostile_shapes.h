// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gallery/mesh_builder.h"
#include "engine/gallery/random_stream.h"
#include "engine/scene/mesh/mesh.h"

#include <glm/vec3.hpp>

namespace limn {

/// Functions that add shapes to a mesh, in arbitrary units and without rounding. Only smooth shapes
/// get normals; those of the others are generated later.

void addTriangle(Mesh& mesh, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c);

/// Adds some faces (bits of Face) of an axis-aligned box, facing in or out.
void addFaces(Mesh& mesh, glm::dvec3 lower, glm::dvec3 upper, unsigned faces, bool inward);

/// Adds a smooth sphere: an octahedron whose triangles are divided into four `levels` times.
void addBall(Mesh& mesh, glm::dvec3 centre, double radius, int levels, bool inward);

/// Adds triangles of that length, with a height of `thinness` times the length.
void addNeedles(Mesh& mesh, double length, double thinness, int count, RandomStream& random);

/// Adds a rough ground of 2 n^2 triangles that extends half of `size` to either side.
void addHills(Mesh& mesh, glm::dvec3 size, int n, RandomStream& random);

} // namespace limn
