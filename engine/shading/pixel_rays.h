// SPDX-License-Identifier: MIT
#pragma once

#include "engine/trace/trace_scene.h"

#include <cmath>
#include <cstdint>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

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

    /// The point of the picture that shows a place, if nothing hides it; none beside the picture,
    /// to whose edge a ten-thousandth more belongs because of rounding.
    std::optional<glm::vec2> pixelOf(glm::vec3 place) const {
        const glm::vec3 way = place - eye;
        const float depth = glm::dot(way, centre) / glm::dot(centre, centre);
        const glm::vec2 ndc(glm::dot(way, right) / (depth * glm::dot(right, right)),
                            -glm::dot(way, up) / (depth * glm::dot(up, up)));
        constexpr float kEdge = 1.0001f;
        if (!(depth > 0 && std::abs(ndc.x) <= kEdge && std::abs(ndc.y) <= kEdge))
            return {};
        return glm::clamp((ndc + 1.f) / 2.f, 0.f, 1.f) * size;
    }
};

} // namespace limn
