// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

namespace limn {

/// Unit direction of the view; -Z if the eye stands on the target.
glm::vec3 forward(const Camera& camera);

/// Moves the target along the optical axis to the depth of `point`, so that the picture stays as it
/// is. Does nothing if the point is not in front of the eye.
void setTargetDepth(Camera& camera, glm::vec3 point);

/// Turns eye and target together about `pivot`, which stays at its place in the picture: yaw about
/// +Y, pitch about the camera's right [rad]. Pitch stops short of the poles. Positive yaw moves the
/// eye to its right, positive pitch up.
void orbit(Camera& camera, glm::vec3 pivot, float yaw, float pitch);

/// Shifts eye and target in the picture plane by fractions of the picture's height at the target's
/// distance.
void pan(Camera& camera, float right, float up);

/// Multiplies the distances of the eye to `point`, which stays at its place in the picture, and to
/// the target by 0.9^steps; keeps the former within [1e-3, 1e6] m.
void zoom(Camera& camera, glm::vec3 point, float steps);

/// Turns the view about the eye [rad]: positive yaw looks to the right, positive pitch up.
void look(Camera& camera, float yaw, float pitch);

/// Moves eye and target along the camera's own axes [m].
void fly(Camera& camera, float right, float up, float forward);

/// Keeps the direction and places the eye so that `bounds` fills the picture. A point counts as a
/// sphere of 1 m.
void focus(Camera& camera, const Bounds& bounds);

/// Sides of the target on which the numpad views place the eye.
enum class Side { Front, Back, Right, Left, Top, Bottom };
void lookFrom(Camera& camera, Side side);

} // namespace limn
