// SPDX-License-Identifier: MIT
#include "engine/scene/reach.h"

#include "engine/scene/origin.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace limn {

bool withinReach(glm::vec3 p) {
    return std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate &&
           std::abs(p.z) <= kMaxCoordinate;
}

std::string reachDefect(const Scene& scene) {
    const std::string beyondLimit = fmt::format("beyond {:g} m of the origin", kMaxCoordinate);
    const auto placed = [&](glm::vec3 p) {
        return withinReach(glm::vec3(toFile(scene.origin, p)));
    };
    for (const Instance& instance : scene.instances)
        for (int c = 0; c < 4; ++c)
            if (!(c < 3 ? withinReach(glm::vec3(instance.toWorld[c]))
                        : placed(glm::vec3(instance.toWorld[c]))))
                return fmt::format("an object of the mesh '{}' lies or extends {}",
                                   scene.meshOf(instance).name, beyondLimit);
    if (!placed(scene.bounds.lower) || !placed(scene.bounds.upper))
        return "the scene extends " + beyondLimit;
    for (const Light& light : scene.lights)
        if (light.kind != LightKind::Directional && !placed(light.position))
            return fmt::format("the light '{}' lies {}", light.name, beyondLimit);
    for (const Camera& camera : scene.cameras)
        if (!placed(camera.eye) || !placed(camera.target))
            return fmt::format("the camera '{}' or its target lies {}", camera.name, beyondLimit);
    return {};
}

} // namespace limn
