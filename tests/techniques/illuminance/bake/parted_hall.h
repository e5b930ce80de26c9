// SPDX-License-Identifier: MIT
#pragma once

#include "tests/trace/simple_scene.h"

namespace limn {

/// A scene with the material of walls, and that of sheets, which shows both sides.
inline simple::SceneBuilder wallsAndSheets() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.7f)));
    Material sheet = simple::lambert(glm::vec3(0.7f));
    sheet.doubleSided = true;
    b.addMaterial(sheet);
    return b;
}

/// A hall of 8 x 3 x 4 m and a wall across it at x = `at` that leaves nothing open: a sheet that
/// shows both sides, or a solid. The hall's floor, ceiling and long walls are one surface each on
/// both sides of it. One lamp hangs in the larger part.
inline Scene partedHall(float wall, std::uint32_t texels, float at = 3.7f) {
    using namespace simple;
    SceneBuilder b = wallsAndSheets();
    b.add(box(glm::vec3(0), glm::vec3(8, 3, 4), true));
    if (wall > 0)
        b.add(box({at, -0.1f, -0.1f}, {at + wall, 3.1f, 4.1f}, false));
    else
        b.add(quad({at, -0.1f, -0.1f}, {0, 3.2f, 0}, {0, 0, 4.2f}, 1));
    b.scene.lights.resize(1);
    b.scene.lights[0].position = {6, 2, 2};
    b.scene.lights[0].strength = 10;
    Scene scene = b.build();
    scene.bake.lightmapCaches = texels;
    scene.bake.surfels = 4 * texels;
    scene.bake.rays = 256;
    return scene;
}

} // namespace limn
