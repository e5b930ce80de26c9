// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/camera.h"

#include <array>
#include <optional>

#include <glm/mat3x3.hpp>
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

/// What a drag of the gizmo changes; Select shows none.
enum class Tool { Select, Move, Rotate, Scale };

/// Parts of a gizmo: one axis; two axes; All of them. All moves in the picture's plane, rotates
/// about the line of sight, scales evenly.
enum class Handle { None, X, Y, Z, YZ, ZX, XY, All };

/// Where a gizmo stands in world space.
struct GizmoFrame {
    glm::vec3 origin{0};
    glm::mat3 axes{1}; ///< columns X, Y, Z: unit and orthogonal
};

/// Radius of the ring that is All for Rotate and Scale, in lengths of an arrow.
inline constexpr float kOuterRing = 1.2f;

/// World-space length of an arrow at `origin`, which is about 90 pixels at any distance [m].
float arrowLength(const Picture& picture, glm::vec3 origin);

/// Corners of a plane handle, and end of an axis arrow, in world space.
std::array<glm::vec3, 4> planeHandle(Handle handle, const GizmoFrame& frame, float length);
glm::vec3 arrowTip(Handle handle, const GizmoFrame& frame, float length);

/// Point of the circle about `normal` through `origin`, at `angle` [rad].
glm::vec3 ringPoint(glm::vec3 origin, glm::vec3 normal, float radius, float angle);

/// Axis of X, Y, Z and normal of YZ, ZX, XY in the frame's own coordinates; 0 for None and All.
glm::vec3 handleAxis(Handle handle);

/// Unit vector from the origin to the eye.
glm::vec3 towardsEye(const Picture& picture, glm::vec3 origin);

/// The handle of `tool` under the mouse; axes take precedence over planes. What is seen edge-on
/// cannot be picked.
Handle handleAt(const Picture& picture, Tool tool, const GizmoFrame& frame, glm::vec2 mouse);

/// World displacement that keeps the grabbed point under the mouse, which went from `start` to
/// `now` [px]. Along an axis: the points of the axis closest to the two rays. In a plane: their
/// intersections. Returns std::nullopt if the axis points at the eye, the plane is edge-on, or a
/// ray misses it.
std::optional<glm::vec3> dragDisplacement(const Picture& picture, Handle handle,
                                          const GizmoFrame& frame, glm::vec2 start, glm::vec2 now);

/// Angle about the handle's axis by which the mouse went round the origin, (-pi, pi] [rad]. For a
/// ring that is seen edge-on: how far it went along the ring, in radii. Returns std::nullopt if a
/// ray misses the ring's plane.
std::optional<float> dragAngle(const Picture& picture, Handle handle, const GizmoFrame& frame,
                               glm::vec2 start, glm::vec2 now);

/// Ratio of the mouse's distances from the origin, now and at the start. On an axis it is that of
/// the closest points, and negative beyond the origin. Returns std::nullopt if the start is at the
/// origin.
std::optional<float> dragFactor(const Picture& picture, Handle handle, const GizmoFrame& frame,
                                glm::vec2 start, glm::vec2 now);

/// Rounds each component to a multiple of `step`, which is greater than 0.
glm::vec3 snapped(glm::vec3 value, float step);

} // namespace limn
