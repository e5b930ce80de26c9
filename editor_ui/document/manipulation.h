// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

namespace limn {

/// A change of where objects stand: scaled, then turned about the pivot, then moved. All in world
/// space.
struct Manipulation {
    glm::vec3 pivot{0};
    glm::vec3 move{0};          ///< [m]
    glm::quat turn{1, 0, 0, 0}; ///< unit
    glm::vec3 scale{1};         ///< along the columns of `axes`; not 0
    glm::mat3 axes{1};          ///< unit, orthogonal
    bool alongOwnAxes = false;  ///< objects grow along their own axes, not along `axes`
};

/// Limits of a node's scale, which a manipulation does not cross [1].
inline constexpr float kMinNodeScale = 1e-6f, kMaxNodeScale = 1e6f;

/// Copy of `object` after the manipulation. A transform has no shear: where turning or scaling a
/// node would need one, because its parents are scaled unevenly or it is scaled along axes that are
/// not its own, its place is exact and its rotation and scale come as near as they can. Scaling
/// changes the size of rectangle lights; of other lights and of cameras it changes the place alone.
/// Returns `object` itself where the result would not be valid.
Object manipulated(const Document& document, const Object& object,
                   const Manipulation& manipulation);

/// `transform` followed by `matrix`, within what a transform can be: as manipulated() says of
/// parents that are scaled unevenly.
Transform transformed(const glm::dmat4& matrix, const Transform& transform);

/// Unit and orthogonal axes of an object in the world. Lights and cameras look down -Z. The world's
/// own axes for whatever has none.
glm::mat3 ownAxes(const Document& document, const Object& object);

} // namespace limn
