// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"
#include "engine/scene/mesh/mesh.h"

#include <span>

namespace limn {

/// World space is the file's coordinates about an origin near the scene, because world positions
/// are floats: in a room of 5 m that lies 1000 km from the file's origin they would be 6 cm apart.

/// From how many times its diagonal on a scene is far from the file's origin. A float has 24 bits;
/// nearer than this, it still tells places apart that are 2^-20 of the diagonal from each other,
/// which is a hundredth of a millimetre in a room.
inline constexpr double kFarInDiagonals = 16;

/// Where to put the origin of a document's world space, in the file's coordinates [m]: at 0, or
/// where the visible static meshes lie far from there, near the centre of the box around them. It
/// is a multiple of a power of two not less than the box's diagonal, so that it has few bits,
/// subtracting it is exact, and small changes of the file leave it where it is. 0 as well where the
/// centre is beyond kMaxCoordinate. Importing a file sets it once: edits do not move it.
glm::dvec3 originOf(const Document& document, std::span<const Mesh> meshes);

/// World point `p` in the file's coordinates.
inline glm::dvec3 toFile(const glm::dvec3& origin, glm::vec3 p) {
    return origin + glm::dvec3(p);
}

/// And back.
inline glm::vec3 toWorld(const glm::dvec3& origin, const glm::dvec3& p) {
    return glm::vec3(p - origin);
}

} // namespace limn
