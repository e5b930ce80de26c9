// SPDX-License-Identifier: MIT
#pragma once

#include "engine/trace/trace_scene.h"

#include <cstdint>

#include <glm/geometric.hpp>

namespace limn {

/// Camera rays of a picture. Directions are affine in the image plane.
struct PixelRays {
    glm::vec3 eye, centre, right, up;
    glm::vec2 size; ///< [pixels]

    PixelRays(const Camera& camera, std::uint32_t width, std::uint32_t height)
        : eye(camera.eye), size(float(width), float(height)) {
        const float aspect = size.x / size.y;
        centre = rayDirection(camera, aspect, 0, 0);
        right = rayDirection(camera, aspect, 1, 0) - centre;
        up = rayDirection(camera, aspect, 0, 1) - centre;
    }

    /// Ray through the point `pixel`: (0, 0) is the picture's upper left corner, `size` its lower
    /// right.
    Ray through(glm::vec2 pixel) const {
        const glm::vec2 ndc = 2.f * pixel / size - 1.f;
        return {eye, glm::normalize(centre + ndc.x * right - ndc.y * up)};
    }
};

} // namespace limn
