// SPDX-License-Identifier: MIT
#include "editor_ui/document/light_angles.h"

#include <algorithm>
#include <cmath>

#include <glm/trigonometric.hpp>

namespace limn {

LightAngles lightAngles(glm::vec3 direction) {
    const glm::vec3 from = -direction;
    const bool vertical = std::hypot(from.x, from.z) < 1e-6f; // rounding alone decides its azimuth
    return {glm::degrees(std::asin(std::clamp(from.y, -1.f, 1.f))),
            vertical ? 0 : glm::degrees(std::atan2(from.x, from.z))};
}

glm::vec3 lightDirection(LightAngles angles) {
    const float e = glm::radians(std::clamp(angles.elevation, -kMaxElevation, kMaxElevation));
    const float a = glm::radians(angles.azimuth);
    return -glm::vec3(std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a));
}

} // namespace limn
