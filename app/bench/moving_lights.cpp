// SPDX-License-Identifier: MIT
#include "app/bench/moving_lights.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

std::vector<Light> pointsOver(const Scene& scene, std::span<const glm::vec3> positions,
                              std::span<const glm::vec3> normals, std::uint32_t count) {
    std::vector<Light> lights(count);
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::size_t s =
            (2 * std::size_t(k) + 1) * positions.size() / (2 * std::size_t(count));
        lights[k].position = positions[s] + normals[s] * (0.05f * glm::length(scene.bounds.size()));
        lights[k].strength = 10;
    }
    return lights;
}

void moveObjects(Scene& scene, const Scene& standing, int k) {
    const float a = 0.1f * float(k), radius = 0.05f * glm::length(standing.bounds.size());
    const glm::vec4 offset(radius * std::sin(a), 0, radius * (std::cos(a) - 1), 0);
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (scene.instances[i].dynamic)
            scene.instances[i].toWorld[3] = standing.instances[i].toWorld[3] + offset;
}

} // namespace limn
