// SPDX-License-Identifier: MIT
#pragma once

#include "tests/trace/simple_scene.h"

namespace limn {

inline Light pointLight(glm::vec3 at, float candela) {
    Light light;
    light.position = at;
    light.strength = candela;
    return light;
}

/// A room with a block, lit by two lamps.
inline Scene room() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false));
    b.scene.lights = {pointLight({2, 2.5f, 2}, 5), pointLight({3, 1, 4}, 2)};
    return b.build();
}

} // namespace limn
