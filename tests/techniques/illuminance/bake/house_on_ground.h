// SPDX-License-Identifier: MIT
#pragma once

#include "tests/trace/simple_scene.h"

namespace limn {

/// A house of 6 x 3 x 5 m whose floor is a ground of 200 x 200 m, times `scale`, under a sky of 1
/// nit. Its walls are 20 cm thick; closed, or with one of them left out.
inline simple::SceneBuilder houseOnGround(float scale, bool closed = true) {
    using namespace simple;
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad(glm::vec3(-90, 0, -110) * scale, glm::vec3(0, 0, 200) * scale,
               glm::vec3(200, 0, 0) * scale));
    const auto addShell = [&](glm::vec3 lower, glm::vec3 upper, bool inward) {
        const Mesh whole = box(lower * scale, upper * scale, inward);
        std::vector<glm::vec3> corners;
        for (std::size_t t = 0; t < whole.triangleCount(); ++t) {
            bool floor = true, front = !closed;
            for (const std::uint32_t v : whole.triangle(t)) {
                floor = floor && whole.positions[v].y == 0;
                front = front && whole.positions[v].x == upper.x * scale;
            }
            if (!floor && !front)
                for (const std::uint32_t v : whole.triangle(t))
                    corners.push_back(whole.positions[v]);
        }
        b.add(flatShaded(corners, 0));
    };
    addShell({0, 0, 0}, {6, 3, 5}, true);
    addShell({-0.2f, 0, -0.2f}, {closed ? 6.2f : 6.f, 3.2f, 5.2f}, false);
    b.scene.sky.radiance = glm::vec3(1);
    return b;
}

} // namespace limn
