// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/mesh.h"

#include <functional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Shapes that add themselves to a mesh [m]. Positions are rounded to 2^-13 m before normals are
/// taken, so that the same program writes the same bytes on every machine. Solids face outward.

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

/// The planar quad a b c d, counter-clockwise from its front.
void addQuad(Mesh& mesh, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d);

/// Some faces of an axis-aligned box.
void addBox(Mesh& mesh, glm::dvec3 lower, glm::dvec3 upper, unsigned faces = AllFaces);

/// A rectangular frame round the y axis: between half-sizes `inner` and `outer` (x, z), from y0 to
/// y1. PositiveX and PositiveZ stand for all faces away from the axis, NegativeX and NegativeZ for
/// all towards it.
void addRing(Mesh& mesh, glm::dvec2 inner, glm::dvec2 outer, double y0, double y1,
             unsigned faces = AllFaces);

/// A smooth sheet: point(u, v) for u, v in [0, 1] in nu x nv quads; its front is where u x v
/// points. `closed`: u = 1 is u = 0, and the normals agree there.
void addSheet(Mesh& mesh, int nu, int nv, bool closed,
              const std::function<glm::dvec3(double, double)>& point);

/// Points (radius, y) of a turned shape, from the bottom up, in smooth pieces: an edge is left
/// between pieces.
using Profile = std::vector<std::vector<glm::dvec2>>;

/// Turns `profile` round the y axis at `centre`. `flutes` > 0 carves that many grooves of `depth`
/// [m].
void addTurned(Mesh& mesh, glm::dvec3 centre, const Profile& profile, int sides, int flutes = 0,
               double depth = 0);

/// An arch moulding in the plane z = 0: `section` (out from the curve, z) is swept along the upper
/// half of the ellipse of `radii` round `centre`, from +x to -x. Consecutive points of the section
/// are flat faces. Ends are open.
void addArch(Mesh& mesh, glm::dvec3 centre, glm::dvec2 radii,
             const std::vector<glm::dvec2>& section, int segments);

/// Round openings in a wall slab along x, z in [-thickness/2, thickness/2], y in [springing, top]:
/// front, back, and what the openings show. Top and ends are left open: they are inside other
/// solids.
struct Opening {
    double x = 0, radius = 1;
};
void addArcadeWall(Mesh& mesh, double halfLength, double springing, double top, double thickness,
                   const std::vector<Opening>& openings, int segments);

/// TEXCOORD_0 from the positions, as if the texture, `size` metres wide, were projected along the
/// axis that each normal is nearest to. Only for meshes whose vertices are not shared between faces
/// of different axes.
void projectUvs(Mesh& mesh, double size);

} // namespace limn
