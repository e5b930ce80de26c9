// SPDX-License-Identifier: MIT
#include "engine/scene/dark_backs.h"
#include "tests/trace/simple_scene.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace limn::scene_test {
namespace {

using simple::box;
using simple::SceneBuilder;

/// Materials 0 to 4: two-sided, one-sided, with holes, glass, a two-sided lamp. A far camera.
SceneBuilder builder() {
    SceneBuilder b;
    Material both = simple::lambert(glm::vec3(0.5f));
    both.doubleSided = true;
    Material holes = both, glass = both, lamp = both;
    holes.alphaMode = AlphaMode::Mask;
    glass.transmission = 0.5f;
    lamp.emission = glm::vec3(1);
    for (const Material& m : {both, simple::lambert(glm::vec3(0.5f)), holes, glass, lamp})
        b.addMaterial(m);
    b.scene.cameras.push_back({.eye = glm::vec3(0x1p50f)});
    return b;
}

/// Which instances' backs are left out.
std::vector<bool> darkOf(Scene scene) {
    leaveOutDarkBacks(scene);
    std::vector<bool> dark;
    for (const Instance& i : scene.instances)
        dark.push_back(i.darkBacks);
    return dark;
}

bool isDark(const Scene& scene) {
    return darkOf(scene)[0];
}

const Mesh kBox = box(glm::vec3(-1), glm::vec3(1), false);

TEST(DarkBacks, AreThoseOfClosedTwoSidedThings) {
    SceneBuilder b = builder();
    for (std::uint32_t material = 0; material < 4; ++material)
        b.add(box(glm::vec3(-1), glm::vec3(1), false, material),
              glm::translate(glm::mat4(1), {4 * float(material), 0, 0}));
    b.add(box(glm::vec3(-8), glm::vec3(8), true));
    b.add(simple::quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    // A one-sided box closes space as well, but has no backs to leave out.
    const Scene scene = b.build();
    EXPECT_EQ(darkOf(scene), (std::vector<bool>{true, false, false, false, false, false}));
    EXPECT_EQ(findClosedSurfaces(scene).size(), 3U);
}

TEST(DarkBacks, OneSidedInABakeAlone) {
    SceneBuilder b = builder();
    b.add(kBox);
    Scene scene = b.build();
    EXPECT_TRUE(isTwoSided(scene, scene.instances[0]));
    leaveOutDarkBacks(scene);
    EXPECT_FALSE(isTwoSided(scene, scene.instances[0]));
    EXPECT_TRUE(isTwoSided(scene.materialOf(scene.instances[0])));
    scene.lights.push_back({.kind = LightKind::Point});
    leaveOutDarkBacks(scene);
    EXPECT_TRUE(isTwoSided(scene, scene.instances[0]));
}

TEST(DarkBacks, AHoleLetsLightIn) {
    SceneBuilder b = builder();
    Mesh open = kBox;
    open.indices.resize(33);
    b.add(open);
    EXPECT_FALSE(isDark(b.build()));
}

TEST(DarkBacks, APaneClosesNoHole) {
    Mesh wall = kBox, pane = kBox;
    wall.indices.resize(30);
    pane.indices.erase(pane.indices.begin(), pane.indices.begin() + 30);
    for (std::uint32_t material = 0; material < 4; ++material) {
        SceneBuilder b = builder();
        b.add(wall);
        pane.material = material;
        b.add(pane);
        EXPECT_EQ(darkOf(b.build()), (std::vector<bool>{material < 2, material < 1})) << material;
    }
}

TEST(DarkBacks, ARoomStaysLitWhereSomeoneIsInIt) {
    SceneBuilder b = builder();
    b.add(kBox);
    const Scene empty = b.build();
    EXPECT_TRUE(isDark(empty));
    const glm::vec3 inside(0.5f, -0.5f, 0.9f), outside(0.5f, -0.5f, 1.1f);
    for (const glm::vec3 place : {inside, outside}) {
        const bool dark = place == outside;
        Scene scene = empty;
        scene.cameras.push_back({.eye = place});
        EXPECT_EQ(isDark(scene), dark);
        for (const LightKind kind : {LightKind::Point, LightKind::Spot, LightKind::Rectangle}) {
            scene = empty;
            scene.lights.push_back({.kind = kind, .enabled = false, .position = place});
            EXPECT_EQ(isDark(scene), dark);
        }
        scene = empty;
        scene.lights.push_back({.kind = LightKind::Directional, .position = place});
        EXPECT_TRUE(isDark(scene));
        const glm::mat4 there = glm::translate(glm::mat4(1), place);
        for (const std::uint32_t material : {0U, 4U})
            for (const bool dynamic : {false, true}) {
                SceneBuilder other = builder();
                other.add(kBox);
                other.add(box(glm::vec3(-0x1p-6f), glm::vec3(0x1p-6f), false, material), there,
                          dynamic);
                EXPECT_EQ(isDark(other.build()), dark || (material == 0 && !dynamic));
            }
    }
}

TEST(DarkBacks, ALampsOwnBacksGlow) {
    SceneBuilder b = builder();
    b.add(box(glm::vec3(-1), glm::vec3(1), false, 4));
    EXPECT_FALSE(isDark(b.build()));
}

TEST(DarkBacks, WallsAreDarkAroundARoomInUse) {
    SceneBuilder b = builder();
    // Two materials, so two meshes: the outside and the room.
    b.add(box(glm::vec3(-4), glm::vec3(4), false));
    b.add(box(glm::vec3(-2), glm::vec3(2), true));
    b.add(kBox, glm::translate(glm::mat4(1), {0, -1, 0}));
    Scene scene = b.build();
    scene.cameras.push_back({.eye = {0, 1.5f, 0}});
    scene.lights.push_back({.kind = LightKind::Point, .position = {1, 1.5f, 0}});
    EXPECT_EQ(darkOf(scene), (std::vector<bool>{true, true, true}));
    scene.lights[0].position.y = 3;
    EXPECT_EQ(darkOf(scene), (std::vector<bool>{false, false, true}));
}

TEST(DarkBacks, NothingIsOutsideARoomThatHoldsEverything) {
    SceneBuilder b = builder();
    b.add(box(glm::vec3(-2), glm::vec3(2), true));
    b.add(box(glm::vec3(-1), glm::vec3(0), false, 4));
    Scene room = b.build();
    room.cameras = {{.eye = glm::vec3(1)}};
    room.lights.push_back({.kind = LightKind::Point, .position = glm::vec3(1.5f)});
    EXPECT_TRUE(isDark(room));
    Scene scene = room;
    scene.cameras[0].eye.y = 3;
    EXPECT_FALSE(isDark(scene));
    scene = room;
    scene.cameras.clear(); // the usual view shows the room from inside, as it is one
    EXPECT_TRUE(isDark(scene));
    scene.lights[0].position.x = -2.5f;
    EXPECT_FALSE(isDark(scene));
    scene = room;
    scene.lights.push_back({.kind = LightKind::Directional, .enabled = false});
    EXPECT_FALSE(isDark(scene));
    scene = room;
    scene.sky.radiance.z = 0.1f;
    EXPECT_FALSE(isDark(scene));
    b.add(simple::quad({0, 0, 4}, {1, 0, 0}, {0, 1, 0}, 4));
    scene = b.build();
    scene.cameras = room.cameras;
    EXPECT_FALSE(isDark(scene));
}

TEST(DarkBacks, AWallThroughABoxIsNeitherOpenNorLight) {
    SceneBuilder b = builder();
    b.add(kBox);
    b.add(simple::quad({0, -4, -4}, {0, 8, 0}, {0, 0, 8}));
    EXPECT_EQ(darkOf(b.build()), (std::vector<bool>{true, false}));
}

TEST(DarkBacks, PlacesMayMirrorAndStretchThings) {
    for (const glm::vec3 scale :
         {glm::vec3(-1, 1, 1), glm::vec3(2, -3, -0.5f), glm::vec3(0x1p-30f), glm::vec3(0x1p30f)}) {
        SceneBuilder b = builder();
        const glm::mat4 place = glm::scale(glm::mat4(1), scale);
        b.add(kBox, place);
        Scene scene = b.build();
        EXPECT_TRUE(isDark(scene)) << scale.x;
        scene.cameras = {{.eye = scale * 0.9f}};
        EXPECT_FALSE(isDark(scene)) << scale.x;
        scene.cameras[0].eye = scale * 1.1f;
        EXPECT_TRUE(isDark(scene)) << scale.x;
    }
    SceneBuilder flat = builder();
    flat.add(kBox, glm::scale(glm::mat4(1), {1, 0, 1}));
    EXPECT_FALSE(isDark(flat.build()));
}

TEST(DarkBacks, InstancesOfAMeshMayDiffer) {
    SceneBuilder b = builder();
    const std::uint32_t mesh = b.addMesh(kBox);
    b.addInstance(mesh);
    b.addInstance(mesh, glm::translate(glm::mat4(1), {5, 0, 0}));
    Scene scene = b.build();
    scene.cameras.push_back({.eye = {5, 0, 0}});
    EXPECT_EQ(darkOf(scene), (std::vector<bool>{true, false}));
}

TEST(DarkBacks, ThingsMayLieTwiceInOnePlace) {
    SceneBuilder b = builder();
    b.add(kBox);
    b.add(kBox);
    EXPECT_EQ(darkOf(b.build()), (std::vector<bool>{true, true}));
}

TEST(DarkBacks, ASheetOnAnEdgeOpensNothing) {
    SceneBuilder b = builder();
    b.add(kBox);
    b.add(simple::quad({-1, -1, -1}, {0, 0, 2}, {-3, -1, 0}));
    b.add(simple::quad({-1, -1, -1}, {-3, 0, 0}, {0, 0, 2}));
    EXPECT_EQ(darkOf(b.build()), (std::vector<bool>{true, false, false}));
}

TEST(DarkBacks, AnInstanceIsTakenAsAWhole) {
    SceneBuilder b = builder();
    Mesh both = kBox;
    for (const std::uint32_t i : {0U, 1U, 2U})
        both.indices.push_back(i); // a sheet on the box
    b.add(both);
    EXPECT_FALSE(isDark(b.build()));
}

} // namespace
} // namespace limn::scene_test
