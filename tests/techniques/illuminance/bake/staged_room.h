// SPDX-License-Identifier: MIT
#pragma once

#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <utility>

#include <glm/gtc/matrix_transform.hpp>

namespace limn {

/// Where the blocks and the ball of the room stand.
struct Blocks {
    glm::mat4 low = glm::translate(glm::mat4(1), glm::vec3(2, 0, 1));
    glm::mat4 tall = glm::translate(glm::mat4(1), glm::vec3(0.5f, 0, 2.5f));
    glm::mat4 ball = glm::translate(glm::mat4(1), glm::vec3(3, 3, 3));
    bool third = false; ///< a block in a corner
    bool wall = false;  ///< across most of the room
};

/// A room of 4 m with a small lamp, a two-sided sheet, blocks of one mesh, and a dynamic ball that
/// brings a grid: every kind of stage has work.
inline Scene stagedRoom(const Blocks& blocks) {
    using namespace simple;
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.addMaterial(lambert(glm::vec3(0.5f), glm::vec3(100)));
    Material sheet = lambert(glm::vec3(0.7f));
    sheet.doubleSided = true;
    b.addMaterial(sheet);
    b.add(box(glm::vec3(0), glm::vec3(4), true));
    b.add(quad({1.8f, 3.9f, 1.8f}, {0.2f, 0, 0}, {0, 0, 0.2f}, 1));
    b.add(quad({3.5f, 0.5f, 0.5f}, {0, 1, 0}, {0, 0, 1}, 2));
    const std::uint32_t block = b.addMesh(box(glm::vec3(0), glm::vec3(1, 1.2f, 1), false));
    b.addInstance(block, blocks.low);
    b.addInstance(block, blocks.tall * glm::scale(glm::mat4(1), glm::vec3(1, 2, 1)));
    const std::uint32_t ball = b.addMesh(sphere(0.2f, 1, false));
    b.addInstance(ball, blocks.ball, true);
    if (blocks.third)
        b.addInstance(block, glm::translate(glm::mat4(1), glm::vec3(0.2f, 2.7f, 0.3f))).node = 99;
    if (blocks.wall)
        b.add(box({2, 0, 0}, {0.05f, 4, 3}, false));
    Scene scene = b.build();
    scene.bake.surfels = 900;
    scene.bake.texelsPerMetre = 2;
    scene.bake.rays = 128;
    scene.bake.links = 24;
    scene.bake.grid = {3, 3, 3};
    return scene;
}

inline Bake baked(const Scene& scene, StageStore* store = nullptr) {
    Result<Bake> result = bake(TraceScene(scene), {}, store);
    EXPECT_TRUE(result) << (result ? "" : result.error().message);
    return result ? std::move(*result) : Bake{};
}

} // namespace limn
