// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/light.h"

#include <vector>

namespace limn {

/// A point light and a rectangle of different colours in a room of 4 x 3 x 5 m, whose size and
/// whose lamps are scaled so that irradiance stays.
inline std::vector<Light> twoLamps(float scale = 1) {
    return {{.name = "Red",
             .kind = LightKind::Point,
             .position = scale * glm::vec3(3, 2.5f, 1),
             .color = glm::vec3(1, 0.2f, 0.1f),
             .strength = 5 * scale * scale},
            {.name = "Blue",
             .kind = LightKind::Rectangle,
             .position = scale * glm::vec3(1.5f, 2.9f, 4),
             .color = glm::vec3(0.1f, 0.3f, 1),
             .strength = 7,
             .size = scale * glm::vec2(0.7f, 0.4f)}};
}

} // namespace limn
