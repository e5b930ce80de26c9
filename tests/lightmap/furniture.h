// SPDX-License-Identifier: MIT
#pragma once

#include "tests/trace/simple_scene.h"

namespace limn::simple {

/// Flat and curved, one-sided and two-sided, several instances of a mesh, in a room.
inline Scene furniture() {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    Material sheet = lambert(glm::vec3(0.5f));
    sheet.doubleSided = true;
    b.addMaterial(sheet);
    b.add(box(glm::vec3(0), glm::vec3(5, 3, 4), true));
    const std::uint32_t ball = b.addMesh(sphere(0.5f, 2, false));
    for (const float x : {1.f, 2.5f}) {
        glm::mat4 place(1);
        place[3] = glm::vec4(x, 0.7f, 1, 1);
        b.addInstance(ball, place);
    }
    b.add(quad({3, 0.5f, 1}, {0, 1.5f, 0}, {0.4f, 0, 1.5f}, 1));
    Scene scene = b.build();
    scene.bake.lightmapCaches = 3000;
    return scene;
}

} // namespace limn::simple
