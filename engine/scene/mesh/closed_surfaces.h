// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/bounds.h"
#include "engine/scene/mesh/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// A triangle of one of several meshes.
struct ShellTriangle {
    std::uint32_t mesh; ///< index into the meshes
    std::uint32_t triangle;

    bool operator==(const ShellTriangle&) const = default;
};

/// A surface whose front and back face different parts of space. Behind a solid's front is what
/// lies inside its outer shell and outside the cavities in it; behind a room's front is all that
/// lies outside the room.
struct ClosedSurface {
    std::vector<ShellTriangle> shell; ///< of a room, or of a solid's outer shell and its cavities
    Bounds bounds;                    ///< of a room, or of a solid's outer shell
    double volume = 0; ///< within `bounds`, in cubic units of the meshes; a room's is negative

    bool isRoom() const { return volume < 0; }
};

/// Finds the closed surfaces of meshes in one object space. Shells are triangles joined along
/// edges; where more than two meet in one, those are joined that have nothing between their backs.
/// Vertices of equal position count as one, whichever mesh they belong to. A shell is closed where
/// each edge occurs as often in one direction as in the other. One whose front faces outwards is
/// the outer shell of a solid. One whose front faces inwards is a cavity of the smallest solid
/// around it, or a room. Shells without volume, and those that turn inside out where they cross
/// themselves, are left out. Triangles with two corners at one place belong to no shell.
std::vector<ClosedSurface> findClosedSurfaces(std::span<const Mesh* const> meshes);

/// How many times a shell winds around a point that is not on it: 1 inside a solid, -1 inside a
/// room, 0 outside and in cavities, up to rounding. The sum of the signed solid angles of the
/// triangles over 4 pi.
/// Van Oosterom, Strackee. The Solid Angle of a Plane Triangle. 1983
double windingNumber(std::span<const Mesh* const> meshes, std::span<const ShellTriangle> shell,
                     glm::dvec3 point);

/// Whether a point lies behind the front of the surface.
bool isBehind(std::span<const Mesh* const> meshes, const ClosedSurface& surface, glm::dvec3 point);

} // namespace limn
