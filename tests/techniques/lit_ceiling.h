// SPDX-License-Identifier: MIT
#pragma once

#include "tests/trace/simple_scene.h"

namespace limn {

/// A floor of 4 x 4 m under a ceiling 3 m above it that a spot light shines at, and between both a
/// black box 1 to 1.2 m above the floor, or none.
inline Scene litCeiling(bool blocked) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.addMaterial(simple::lambert(glm::vec3(0)));
    b.add(simple::quad({-2, 3, -2}, {4, 0, 0}, {0, 0, 4})); // faces down
    b.add(simple::quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0})); // faces up
    if (blocked)
        b.add(simple::box({-0.6f, 1, -0.6f}, {0.6f, 1.2f, 0.6f}, false, 1));
    b.scene.lights = {{.kind = LightKind::Spot,
                       .position = {0, 1.5f, 0},
                       .direction = {0, 1, 0},
                       .strength = 10,
                       .outerAngle = 0.5f}};
    return b.build();
}

} // namespace limn
