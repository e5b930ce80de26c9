// SPDX-License-Identifier: MIT
#pragma once

#include "tests/trace/simple_scene.h"

namespace limn {

/// A box with a two-sided sheet and a moving box in it, one lamp, a sky outside.
inline Scene smallRoom() {
    using namespace simple;
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f), glm::vec3(1)));
    Material sheet = lambert(glm::vec3(0.8f, 0.4f, 0.2f));
    sheet.doubleSided = true;
    b.addMaterial(sheet);
    b.add(box(glm::vec3(0), glm::vec3(2), true));
    b.add(quad({0.5f, 0.5f, 0.5f}, {1, 0, 0}, {0, 0.5f, 0}, 1));
    b.add(box(glm::vec3(1.2f, 0, 1.2f), glm::vec3(1.6f), false), glm::mat4(1), true);
    Light lamp;
    lamp.kind = LightKind::Point;
    lamp.position = {1, 1.5f, 1};
    lamp.strength = 10;
    b.scene.lights.push_back(lamp);
    b.scene.sky.radiance = glm::vec3(1);
    return b.build();
}

} // namespace limn
