// SPDX-License-Identifier: MIT
#pragma once

#include "tests/trace/simple_scene.h"

#include <memory>

namespace limn {

/// A room with a block and one lamp, quickly baked; with `holes`, below a sheet that has some.
inline std::shared_ptr<const Scene> litRoom(std::uint32_t surfels, std::uint32_t lightmapCaches,
                                            bool holes = false) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    if (holes) {
        b.assets->images.push_back({"holes", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}});
        Material sheet = simple::lambert(glm::vec3(0.5f));
        sheet.alphaMode = AlphaMode::Mask;
        sheet.baseColorTexture.image = 0;
        b.add(simple::quad({0.5f, 2, 0.5f}, {0, 0, 3}, {3, 0, 0}, b.addMaterial(sheet)));
    }
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

/// A room with a block off its floor, lit by nothing; with a `window`, open on one side.
inline Scene hall(LinkStorage storage, std::uint32_t bands, bool window = false) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    Mesh walls = simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true);
    if (window)
        walls.indices.resize(walls.indices.size() - 6);
    b.add(walls);
    b.add(simple::box(glm::vec3(1, 0.3f, 1), glm::vec3(2, 2, 2), false));
    b.scene.bake.storage = storage;
    b.scene.bake.bands = bands;
    b.scene.bake.surfels = 500;
    b.scene.bake.grid = {3, 2, 3};
    return b.build();
}

} // namespace limn
