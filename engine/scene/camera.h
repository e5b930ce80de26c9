// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// A perspective camera in world space.
struct Camera {
    std::string name = "Camera";
    glm::vec3 eye{0, 1, 3};
    glm::vec3 target{0};   ///< a point on the optical axis
    glm::vec3 up{0, 1, 0}; ///< unit
    float fovY = 0.9f;     ///< vertical field of view [rad]

    bool operator==(const Camera&) const = default;
};

/// The position and projection from which a picture is seen.
struct Viewpoint {
    Camera camera;
    float aspect = 1;   ///< width over height
    glm::uvec2 size{0}; ///< of the picture [pixels]; 0: there is none
    bool operator==(const Viewpoint&) const = default;
};

/// The view of a picture of `size` pixels, both > 0.
inline Viewpoint viewpointOf(const Camera& camera, glm::uvec2 size) {
    return {camera, float(size.x) / float(size.y), size};
}

/// World to view transform; the view looks down -Z. Robust if `up` is parallel to the view
/// direction.
glm::mat4 viewMatrix(const Camera& camera);

/// Reverse-free projection, depth [0, 1], y up in clip space (Vulkan callers flip the viewport).
glm::mat4 projectionMatrix(const Camera& camera, float aspect, float zNear, float zFar);

/// Unnormalised world direction through the pixel-plane point ndc in [-1, 1]^2, y up.
glm::vec3 rayDirection(const Camera& camera, float aspect, float ndcX, float ndcY);

} // namespace limn
