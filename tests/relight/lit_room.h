// SPDX-License-Identifier: MIT
#pragma once

#include "tests/trace/simple_scene.h"

#include <memory>

namespace limn {

/// A room with a block and one lamp, quickly baked.
inline std::shared_ptr<const Scene> litRoom(std::uint32_t surfels, std::uint32_t lightmapCaches) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false));
    b.scene.lights.resize(1);
    b.scene.lights[0].position = {2, 2.5f, 2};
    b.scene.lights[0].strength = 5;
    b.scene.bake.surfels = surfels;
    b.scene.bake.lightmapCaches = lightmapCaches;
    b.scene.bake.rays = 64;
    b.scene.bake.links = 32;
    b.scene.bake.grid = {2, 2, 2};
    return std::make_shared<const Scene>(b.build());
}

} // namespace limn
