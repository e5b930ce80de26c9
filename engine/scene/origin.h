// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"
#include "engine/scene/mesh/mesh.h"

#include <span>
#include <string>

namespace limn {

/// World space is the file's coordinate system with its origin moved near the scene, because world
/// positions are floats: in a room of 5 m at 1000 km from the file's origin they would be 6 cm
/// apart.

/// A scene counts as far from the file's origin from this many times its diagonal on. Floats have
/// 24 bits: nearer than this, they still distinguish positions 2^-20 of the diagonal apart, which
/// is a hundredth of a millimetre in a room.
inline constexpr double kFarInDiagonals = 16;

/// Chooses the origin of a document's world space, in the file's coordinates [m]. It is 0, or, if
/// the visible static meshes lie far from there, a point near the centre of their bounding box. The
/// point is a multiple of a power of two not less than the box's diagonal, so that it has few bits,
/// subtracting it is exact, and small changes of the file do not move it. It is also 0 if the
/// centre is beyond kMaxCoordinate. The origin is set once when a file is imported; edits do not
/// move it.
glm::dvec3 originOf(const Document& document, std::span<const Mesh> meshes);

/// Converts world point `p` to the file's coordinates.
inline glm::dvec3 toFile(const glm::dvec3& origin, glm::vec3 p) {
    return origin + glm::dvec3(p);
}

/// "At 1.2, 0, -3.4 m", world point `p` in the file's coordinates.
std::string placeText(const glm::dvec3& origin, glm::vec3 p);

/// Converts point `p` in the file's coordinates to world space.
inline glm::vec3 toWorld(const glm::dvec3& origin, const glm::dvec3& p) {
    return glm::vec3(p - origin);
}

} // namespace limn
