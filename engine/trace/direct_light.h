// SPDX-License-Identifier: MIT
#pragma once

#include "engine/trace/trace_scene.h"

#include <cstdint>

namespace limn {

/// A receiver of direct light.
struct LitPoint {
    glm::vec3 position{0}; ///< clear of its surface
    glm::vec3 normal{0};   ///< unit, on the lit side
    glm::vec2 shift{0};    ///< in [0, 1)^2, rotates the points on rectangles
};

/// Irradiance [W m^-2] from one light, with shadow. Shadows of directional, point and spot lights
/// are hard; those of a rectangle are sampled by `points` rays. Adds the number of shadow rays to
/// `rays`.
glm::vec3 shadowedLight(const TraceScene& trace, const Light& light, const LitPoint& point,
                        std::uint32_t points, std::uint64_t& rays);

} // namespace limn
