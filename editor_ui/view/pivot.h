// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

struct EditorState;

/// World point of the nearest surface under a pixel of the window; std::nullopt if there is none,
/// or no scene to trace yet.
std::optional<glm::vec3> surfaceUnder(const EditorState& state, glm::vec2 pixel);

/// The world point about which the view turns, and towards which it zooms, with the mouse at
/// `pixel`: the surface under it. Without one, a point on the pixel's ray at the depth of the
/// selection, else of what the middle of the picture sees, else of the scene's middle. It always
/// lies in front of the eye, unless the camera is degenerate.
glm::vec3 pivotUnder(const EditorState& state, glm::vec2 pixel);

/// Moves the camera's target along the optical axis to the depth of what the middle of the picture
/// sees, as pivotUnder() finds it. The picture stays the same.
void aimAtMiddle(EditorState& state);

} // namespace limn
