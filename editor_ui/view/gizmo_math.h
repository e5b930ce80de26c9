// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/camera.h"

#include <array>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Where a camera's picture lies in the window: pixels, y down.
struct Picture {
    Camera camera;
    glm::vec2 origin{0}, size{1};

    float aspect() const { return size.x / size.y; }
};

/// Pixel of a world point; std::nullopt if it is not in front of the eye.
std::optional<glm::vec2> toPixel(const Picture& picture, glm::vec3 world);

/// Unit direction from the eye through a pixel.
glm::vec3 pixelDirection(const Picture& picture, glm::vec2 pixel);

/// The parts of the translate gizmo.
enum class Handle { None, X, Y, Z, YZ, ZX, XY };

/// World-space length of an arrow at `origin`, which is about 90 pixels at any distance [m].
float arrowLength(const Picture& picture, glm::vec3 origin);

/// Corners of a plane handle, and end of an axis arrow, in world space.
std::array<glm::vec3, 4> planeHandle(Handle handle, glm::vec3 origin, float length);
glm::vec3 arrowTip(Handle handle, glm::vec3 origin, float length);

/// Axis of X, Y, Z; normal of YZ, ZX, XY.
glm::vec3 handleAxis(Handle handle);

/// The handle under the mouse; arrows take precedence over planes. Axes that point at the eye
/// cannot be picked.
Handle handleAt(const Picture& picture, glm::vec3 origin, glm::vec2 mouse);

/// World displacement that keeps the grabbed point under the mouse, which went from `start` to
/// `now` [px]. Along an axis: the points of the axis closest to the two rays. In a plane: their
/// intersections. Returns std::nullopt if the axis points at the eye, the plane is edge-on, or a
/// ray misses it.
std::optional<glm::vec3> dragDisplacement(const Picture& picture, Handle handle, glm::vec3 origin,
                                          glm::vec2 start, glm::vec2 now);

/// Rounds each component that moved to a multiple of `step` [m].
glm::vec3 snapped(glm::vec3 displacement, float step);

} // namespace limn
