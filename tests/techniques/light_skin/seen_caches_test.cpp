// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/skin_state.h"
#include "engine/techniques/light_skin/view_samples.h"
#include "tests/techniques/light_skin/lit_by_skin.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace limn::seen_caches_test {
namespace {

/// A room with a block, a ball and a pane with two sides.
Scene room() {
    simple::SceneBuilder b;
    Material m = simple::lambert({0.7f, 0.5f, 0.3f});
    b.addMaterial(m);
    m.doubleSided = true;
    b.addMaterial(m);
    b.add(simple::box(glm::vec3(0), {4, 3, 5}, true));
    b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false));
    b.add(simple::sphere(0.5f, 4, false), glm::translate(glm::mat4(1), glm::vec3(2.8f, 0.7f, 2)));
    b.add(simple::quad({0.4f, 1, 2.7f}, {0.9f, 0, 0.4f}, {0, 1.2f, 0}, 1));
    b.scene.lights = {{.kind = LightKind::Point, .position = {3, 2.5f, 1.5f}, .strength = 10}};
    b.scene.technique.settings = {{"light-skin.map_size", 24},
                                  {"light-skin.vals", 200},
                                  {"light-skin.spacing", 4},
                                  {"light-skin.visible_caches", 1}};
    return b.build();
}

Viewpoint viewOf() {
    return {.camera = {.eye = {3.6f, 1.5f, 4.6f}, .target = {1, 1, 1}, .fovY = 1.1f},
            .aspect = 1.5f,
            .size = {192, 128}};
}

TEST(SeenCaches, AreThoseThatFaceTheEyeInThePictureAndAreNotHidden) {
    const Scene scene = room();
    const TraceScene trace(scene);
    MeshSkins skins;
    const LightCaches caches = skins.place(scene, {0.04f, 0.5f, false});
    const Viewpoint view = viewOf();
    const glm::mat4 toClip =
        projectionMatrix(view.camera, view.aspect, 0.1f, 100) * viewMatrix(view.camera);
    std::vector<glm::vec3> expected;
    std::size_t inPicture = 0;
    for (std::size_t c = 0; c < caches.size(); ++c) {
        const glm::vec3 p = caches.position[c], n = caches.normal[c];
        const glm::vec4 clip = toClip * glm::vec4(p, 1);
        if (!(clip.w > 0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w))
            continue;
        ++inPicture;
        // A cache on a ball may lie within it, below the facets that it stands for.
        if (glm::dot(n, view.camera.eye - p) > 0 && !trace.blocked(view.camera.eye, p + 0.03f * n))
            expected.push_back(p);
    }
    const CachesInView candidates = cachesInView(caches, view);
    const ViewSamples seen = seenCaches(trace, scene, candidates, view);
    std::printf("%zu caches, %zu in the picture, %zu seen, %zu expected\n", caches.size(),
                inPicture, seen.size(), expected.size());
    EXPECT_GT(expected.size(), caches.size() / 10);
    EXPECT_LT(expected.size(), inPicture - 100) << "backs and what is hidden";
    // Those on outlines may fall to either side.
    std::size_t both = 0;
    for (const glm::vec3 p : expected)
        both += std::ranges::count(seen.position, p);
    EXPECT_LE(expected.size() - both, expected.size() / 50);
    EXPECT_LE(seen.size() - both, expected.size() / 50);
    for (std::size_t i = 0; i < seen.size(); ++i)
        EXPECT_GT(glm::dot(seen.normal[i], view.camera.eye - seen.position[i]), 0);
}

TEST(SeenCaches, AreTheSamplesOfAnUpdateWithAView) {
    LitBySkin lit(room());
    const Viewpoint view = viewOf();
    const auto samplesOf = [&](const Viewpoint* shown) {
        SkinState state;
        SkinCost cost;
        EXPECT_TRUE(state.follow(
            lit.scene, skinInputsOf(lit.scene, shown),
            [&]() -> const TraceScene& { return *lit.trace; }, {}, cost));
        EXPECT_EQ(shown == nullptr, cost.rays == 6 * 24 * 24) << "one more for each candidate";
        const ViewSamples expected =
            shown ? seenCaches(*lit.trace, lit.scene,
                               cachesInView(*state.objects().caches(), *shown), *shown)
                  : samplesOfSurfaces(lit.scene, 256);
        EXPECT_EQ(state.samples().position, expected.position);
        EXPECT_GT(expected.size(), 100U);
    };
    samplesOf(&view);
    samplesOf(nullptr);
    // Without a picture's size, pixels are those of 1024 rows.
    Viewpoint unsized = view;
    unsized.size = {0, 0};
    EXPECT_EQ(sampledPixels(unsized), glm::uvec2(1536, 1024));
    EXPECT_EQ(sampledPixels(view), view.size);
    samplesOf(&unsized);
}

} // namespace
} // namespace limn::seen_caches_test
