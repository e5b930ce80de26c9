// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gallery/mesh_builder.h"
#include "engine/gallery/random_stream.h"
#include "engine/scene/mesh/mesh.h"

#include <glm/vec3.hpp>

namespace limn {

/// Shapes that add themselves to a mesh, in a unit of their own and without rounding; normals are
/// left to be generated unless they are smooth.

void addTriangle(Mesh& mesh, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c);

/// Some faces (bits of Face) of a box along the axes, facing in or out.
void addFaces(Mesh& mesh, glm::dvec3 lower, glm::dvec3 upper, unsigned faces, bool inward);

/// An octahedron whose triangles were divided in four `levels` times, on a sphere, smooth.
void addBall(Mesh& mesh, glm::dvec3 centre, double radius, int levels, bool inward);

/// Triangles of that length, `thinness` of it high.
void addNeedles(Mesh& mesh, double length, double thinness, int count, RandomStream& random);

/// A rough ground of 2 n^2 triangles, half of `size` to either side.
void addHills(Mesh& mesh, glm::dvec3 size, int n, RandomStream& random);

} // namespace limn
