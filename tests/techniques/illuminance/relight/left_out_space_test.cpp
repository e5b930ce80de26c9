// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/left_out_space.h"
#include "tests/techniques/illuminance/bake/staged_room.h"

#include <gtest/gtest.h>

namespace limn::left_out_space_test {
namespace {

/// The room with two-sided blocks and walls, seen by a camera in the air.
Scene roomOf() {
    Scene scene = stagedRoom({});
    scene.cameras.push_back({.eye = glm::vec3(1, 3, 1)});
    scene.materials[0].doubleSided = true;
    return scene;
}

const glm::vec3 kInBlock(2.5f, 0.6f, 1.5f), kInRoom(1, 3, 2), kOutside(1, 5, 2);

TEST(LeftOutSpace, LacksWhatComesIntoIt) {
    const Scene baked = roomOf();
    const Bake bake = limn::baked(baked);
    ASSERT_EQ(bake.lightmap.instances[0].backRows, 0U);
    ASSERT_EQ(bake.lightmap.instances[3].backRows, 0U);
    LeftOutSpace space;
    const auto lacks = [&](const Scene& scene) {
        return space.lackOf(bake, baked, scene) != nullptr;
    };
    EXPECT_FALSE(lacks(baked));
    for (const glm::vec3 place : {kInRoom, kInBlock, kOutside}) {
        Scene scene = baked;
        scene.lights.push_back({.kind = LightKind::Point, .position = place});
        EXPECT_EQ(lacks(scene), place != kInRoom);
        scene.lights[0].enabled = false;
        EXPECT_FALSE(lacks(scene));
        scene = baked;
        scene.instances.back().toWorld[3] = glm::vec4(place, 1);
        EXPECT_EQ(lacks(scene), place != kInRoom);
    }
    Scene scene = baked;
    scene.sky.radiance = glm::vec3(1);
    EXPECT_TRUE(lacks(scene));
    scene = baked;
    scene.lights.push_back({.kind = LightKind::Directional});
    EXPECT_TRUE(lacks(scene));
    EXPECT_FALSE(lacks(baked));
}

TEST(LeftOutSpace, IsWhatTheBakeLeftOut) {
    Scene baked = roomOf();
    Scene lit = baked;
    lit.lights.push_back({.kind = LightKind::Point, .position = kInBlock});
    baked.cameras[0].eye = kInBlock;
    const Bake seen = limn::baked(baked);
    EXPECT_EQ(LeftOutSpace().lackOf(seen, baked, lit), nullptr);
    const Bake none = limn::baked(stagedRoom({}));
    EXPECT_EQ(LeftOutSpace().lackOf(none, stagedRoom({}), lit), nullptr);
}

} // namespace
} // namespace limn::left_out_space_test
