// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/mesh.h"

#include <functional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Functions that add shapes to a mesh [m]. Positions are rounded to 2^-13 m before normals are
/// computed, so that the same program produces the same bytes on every machine. Solids face
/// outward.

/// Bits of the faces of a box or a ring.
enum Face : unsigned {
    NegativeX = 1,
    PositiveX = 2,
    NegativeY = 4,
    PositiveY = 8,
    NegativeZ = 16,
    PositiveZ = 32,
    AllFaces = 63
};

/// Adds the planar quad a b c d, counter-clockwise seen from its front.
void addQuad(Mesh& mesh, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d);

/// Adds some faces of an axis-aligned box.
void addBox(Mesh& mesh, glm::dvec3 lower, glm::dvec3 upper, unsigned faces = AllFaces);

/// Adds a rectangular frame around the y axis, between half-sizes `inner` and `outer` (x, z), from
/// y0 to y1. PositiveX and PositiveZ stand for all faces away from the axis, NegativeX and
/// NegativeZ for all faces towards it.
void addRing(Mesh& mesh, glm::dvec2 inner, glm::dvec2 outer, double y0, double y1,
             unsigned faces = AllFaces);

/// Adds a smooth sheet: point(u, v) for u, v in [0, 1] in nu x nv quads. Its front is where u x v
/// points. If `closed`, u = 1 coincides with u = 0 and the normals agree there.
void addSheet(Mesh& mesh, int nu, int nv, bool closed,
              const std::function<glm::dvec3(double, double)>& point);

/// Points (radius, y) of a solid of revolution, from the bottom up, in smooth pieces; normals have
/// an edge between pieces.
using Profile = std::vector<std::vector<glm::dvec2>>;

/// Adds `profile` revolved around the y axis at `centre`. `flutes` > 0 carves that many grooves of
/// `depth` [m].
void addTurned(Mesh& mesh, glm::dvec3 centre, const Profile& profile, int sides, int flutes = 0,
               double depth = 0);

/// Adds an arch moulding in the plane z = 0: `section` (out from the curve, z) is swept along the
/// upper half of the ellipse of `radii` around `centre`, from +x to -x. Consecutive points of the
/// section form flat faces. The ends are open.
void addArch(Mesh& mesh, glm::dvec3 centre, glm::dvec2 radii,
             const std::vector<glm::dvec2>& section, int segments);

/// A round opening in the wall of addArcadeWall(): a slab along x, z in [-thickness/2,
/// thickness/2], y in [springing, top], with its front, its back and the inner faces of the
/// openings. Top and ends are left open, because they are inside other solids.
struct Opening {
    double x = 0, radius = 1;
};
void addArcadeWall(Mesh& mesh, double halfLength, double springing, double top, double thickness,
                   const std::vector<Opening>& openings, int segments);

/// Computes TEXCOORD_0 from the positions by projecting the texture, `size` metres wide, along the
/// axis nearest to each normal. Only for meshes whose vertices are not shared between faces of
/// different axes.
void projectUvs(Mesh& mesh, double size);

} // namespace limn
