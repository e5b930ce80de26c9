// SPDX-License-Identifier: MIT
#include "tests/techniques/illuminance/relight/relit.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

namespace limn::leak_test {
namespace {

using namespace simple;

/// One mesh of several boxes: a clustering by mesh may join any of their faces.
Mesh joined(std::initializer_list<Mesh> parts) {
    std::vector<glm::vec3> corners;
    for (const Mesh& m : parts)
        for (const std::uint32_t i : m.indices)
            corners.push_back(m.positions[i]);
    return flatShaded(corners, 0);
}

constexpr float kWall = 0.05f;

/// A sealed room of 2 x 2 x 2 m with thin walls on a sunlit ground that is its floor as well: one
/// plane, dark and bright, that clusters may span.
Scene sealedRoom() {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.7f)));
    b.add(joined({quad({-4, 0, -4}, {0, 0, 10}, {10, 0, 0}),
                  box(glm::vec3(0, -kWall, 0), glm::vec3(2), true),
                  box(glm::vec3(-kWall), glm::vec3(2 + kWall), false)}));
    Light sun;
    sun.kind = LightKind::Directional;
    sun.direction = glm::normalize(glm::vec3(-0.6f, -1, -0.4f));
    sun.strength = 10;
    b.scene.lights = {sun};
    b.scene.sky.radiance = glm::vec3(0.5f);
    Scene scene = b.build();
    scene.bake.surfels = 8192;
    scene.bake.lightmapCaches = 2000;
    scene.bake.rays = 512;
    return scene;
}

/// Mean indirect irradiance at the caches of the room's inner faces over that of all others.
double leak(CutCriterion cut, std::uint32_t links) {
    Scene scene = sealedRoom();
    scene.bake.cut = cut;
    scene.bake.links = links;
    const Relit room(scene);
    const Caches& caches = room.caches;
    double inside = 0, outside = 0;
    int insideCount = 0, outsideCount = 0;
    for (std::uint32_t c = 0; c < caches.lightmapCount; ++c) {
        const glm::vec3 p = caches.position[c];
        if (caches.linkBegin[c] == caches.linkBegin[c + 1])
            continue; // in a wall
        const bool in = glm::all(glm::greaterThan(p, glm::vec3(-1e-3f))) &&
                        glm::all(glm::lessThan(p, glm::vec3(2 + 1e-3f)));
        const double E = room.irradiance(c);
        (in ? inside : outside) += E;
        ++(in ? insideCount : outsideCount);
    }
    EXPECT_GT(insideCount, 100);
    EXPECT_GT(outsideCount, 100);
    return (inside / insideCount) / (outside / outsideCount);
}

TEST(Leak, OfTheCutIntoASealedRoomIsAtMostAQuarterOfThePapers) {
    // What leaks without any cut: surfels and texels of the floor that reach under the walls.
    const double uncut = leak(CutCriterion::SolidAngle, 4096);
    EXPECT_LT(uncut, 0.03);
    for (const std::uint32_t links : {64U, 128U}) {
        const double paper = leak(CutCriterion::SolidAngle, links) - uncut;
        const double detail = leak(CutCriterion::Detail, links) - uncut;
        RecordProperty("paper_" + std::to_string(links), std::to_string(paper));
        RecordProperty("detail_" + std::to_string(links), std::to_string(detail));
        EXPECT_GT(paper, 0.005);
        EXPECT_LT(detail, paper / 4) << links << " links; without a cut " << uncut;
    }
}

} // namespace
} // namespace limn::leak_test
