// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <glm/geometric.hpp>

namespace limn {

inline constexpr LightKind kLightKinds[] = {LightKind::Directional, LightKind::Point,
                                            LightKind::Spot, LightKind::Rectangle};

/// A coloured light from (3.2, 2.6, 4.2) towards the origin's side.
inline Light lightOf(LightKind kind) {
    Light l;
    l.kind = kind;
    l.position = {3.2f, 2.6f, 4.2f};
    l.direction = glm::normalize(glm::vec3(-0.6f, -0.7f, -0.5f));
    l.color = {1, 0.5f, 0.25f};
    l.strength = 8;
    l.innerAngle = 0.3f;
    l.outerAngle = 0.9f;
    l.size = {1.2f, 0.8f};
    return l;
}

/// Adds a light of each kind.
inline Scene withLightsOfEachKind(Scene scene) {
    for (const LightKind kind : kLightKinds)
        scene.lights.push_back(lightOf(kind));
    return scene;
}

} // namespace limn
