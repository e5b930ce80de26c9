// SPDX-License-Identifier: MIT
#pragma once

#include "tests/trace/simple_scene.h"

#include <glm/gtc/matrix_transform.hpp>

namespace limn {

/// A room with a ball, a mirrored and stretched box and a two-sided pane, all somewhat glossy, lit
/// by a spot. `open`: of the room, there are a floor and two walls only.
inline Scene glossyRoom(bool open = false) {
    simple::SceneBuilder b;
    Material m = simple::lambert({0.7f, 0.5f, 0.3f});
    m.roughness = 0.35f;
    b.addMaterial(m);
    m.metallic = 1;
    m.roughness = 0.5f;
    b.addMaterial(m);
    m = simple::lambert({0.2f, 0.6f, 0.9f});
    m.doubleSided = true;
    b.addMaterial(m);
    if (open) {
        b.add(simple::quad(glm::vec3(0), {0, 0, 5}, {4, 0, 0}));
        b.add(simple::quad(glm::vec3(0), {4, 0, 0}, {0, 3, 0}));
        b.add(simple::quad(glm::vec3(0), {0, 3, 0}, {0, 0, 5}));
    } else {
        b.add(simple::box(glm::vec3(0), {4, 3, 5}, true));
    }
    b.add(simple::sphere(0.6f, 3, false, 1), glm::translate(glm::mat4(1), glm::vec3(2.7f, 0.8f, 2)),
          true);
    b.add(simple::box({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}, false),
          glm::translate(glm::mat4(1), glm::vec3(1.1f, 0, 1.2f)) *
              glm::scale(glm::mat4(1), glm::vec3(-0.8f, 1.6f, 0.7f)));
    b.add(simple::quad({0.4f, 0.6f, 2.7f}, {0.9f, 0, 0.4f}, {0, 1.2f, 0}, 2));
    b.scene.lights = {{.kind = LightKind::Spot,
                       .position = {2, 2.7f, 3},
                       .direction = {0, -1, 0},
                       .color = {1, 0.8f, 0.5f},
                       .strength = 30,
                       .outerAngle = 0.8f}};
    b.scene.technique.settings = {{"light-skin.spacing", 4}, {"light-skin.map_size", 48}};
    return b.build();
}

} // namespace limn
