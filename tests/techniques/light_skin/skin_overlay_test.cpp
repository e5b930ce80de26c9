// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/skin_overlay.h"

#include "tests/techniques/light_skin/lit_by_skin.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace limn::skin_overlay_test {
namespace {

/// A room with a box, lit by a spot, and its snapshot.
struct Shown {
    LitBySkin lit;
    Viewpoint view{.camera = {.eye = {3.5f, 1.5f, 4.5f}, .target = {1, 0.5f, 1}},
                   .aspect = 1,
                   .size = {64, 64}};
    std::shared_ptr<const LightSnapshot> light;

    Shown() : lit(room()) {
        lit.update(&view);
        light = lit.lighting->snapshot();
    }
    static Scene room() {
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.6f)));
        b.add(simple::box(glm::vec3(0), {4, 3, 5}, true));
        b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false));
        b.scene.lights = {{.kind = LightKind::Spot,
                           .position = {2, 2.8f, 2},
                           .direction = {0, -1, 0},
                           .strength = 10,
                           .outerAngle = 0.7f}};
        b.scene.technique.settings = {
            {"light-skin.spacing", 5}, {"light-skin.vals", 200}, {"light-skin.map_size", 40}};
        return b.build();
    }
    OverlayData overlay(std::size_t kind, std::uint32_t pick = ~0U) const {
        return light->overlay({.kind = &kSkinOverlays[kind], .pick = pick}, lit.scene, light.get());
    }
    Hit hit(glm::vec3 from, glm::vec3 direction) const {
        return lit.trace->closestHit({from, direction});
    }
};

TEST(SkinOverlay, CachesAreDiscsOfAllSurfaces) {
    const Shown shown;
    double area = 0, surfaces = 0;
    for (const OverlayMark& mark : shown.overlay(0).marks)
        area += std::numbers::pi * double(mark.radius) * double(mark.radius);
    for (const Mesh& mesh : shown.lit.scene.assets->meshes)
        surfaces += simple::areaOf(mesh);
    EXPECT_NEAR(area / surfaces, 1, 1e-3);
    EXPECT_EQ(shown.overlay(0).marks.size(), shown.light->pickCount());
}

TEST(SkinOverlay, RingsAreAboutTheChosenTexels) {
    const Shown shown;
    const OverlayData data = shown.overlay(1);
    const auto rings = std::ranges::count(data.marks, MarkShape::Ring, &OverlayMark::shape);
    EXPECT_GT(rings, 50);
    EXPECT_LE(rings, 200) << "each once";
    for (const OverlayMark& mark : data.marks)
        EXPECT_NEAR(glm::length(mark.normal), 1, 1e-4f);
}

TEST(SkinOverlay, APickIsTheNearestCacheOfTheSideThatWasHit) {
    const Shown shown;
    const Hit hit = shown.hit({2.5f, 1, 2.5f}, {0, -1, 0});
    const auto pick = shown.light->pickAt(shown.lit.scene, hit);
    ASSERT_TRUE(pick);
    const LightCaches& caches = *shown.lit.part().light().caches;
    EXPECT_GT(caches.normal[*pick].y, 0.99f);
    for (std::size_t c = 0; c < caches.size(); ++c)
        if (caches.normal[c].y > 0.99f) {
            EXPECT_GE(glm::distance(caches.position[c], hit.position),
                      glm::distance(caches.position[*pick], hit.position));
        }
    EXPECT_EQ(shown.light->nearestPick(*shown.light, *pick), pick);
    Hit unknown = hit;
    unknown.instance = 99;
    EXPECT_FALSE(shown.light->pickAt(shown.lit.scene, unknown));
    const std::vector<OverlayLine> lines = shown.light->describePick(shown.lit.scene, *pick);
    EXPECT_GT(lines.size(), 8U) << "both proxies";
    EXPECT_GT(shown.overlay(2, *pick).marks.size(), 100U);
}

TEST(SkinOverlay, WeightsThatAreToldSumToAll) {
    const Shown shown;
    const Hit hit = shown.hit({2.5f, 1, 2.5f}, {0, -1, 0});
    const std::vector<OverlayLine> lines = shown.light->describeAt(
        {.kind = &kSkinOverlays[3]}, shown.lit.scene, hit, shown.light.get());
    ASSERT_GT(lines.size(), 4U);
    double sum = 0;
    for (std::size_t i = 1; i < lines.size(); ++i)
        sum += std::stod(lines[i].text);
    EXPECT_NEAR(sum, 100, 0.05 * double(lines.size()));
    const auto pick = shown.light->pickAt(shown.lit.scene, hit);
    EXPECT_GT(shown.overlay(3, *pick).marks.size(), 4U);
    const std::vector<OverlayLine> other = shown.light->describeAt(
        {.kind = &kSkinOverlays[0]}, shown.lit.scene, hit, shown.light.get());
    EXPECT_EQ(other.size(), shown.light->describePick(shown.lit.scene, *pick).size());
}

TEST(SkinOverlay, SamplesAreThoseOfTheView) {
    Shown shown;
    EXPECT_EQ(shown.overlay(4).marks.size(), 256U);
    shown.lit.scene.technique.settings["light-skin.all"] = 1;
    shown.lit.update(&shown.view);
    shown.light = shown.lit.lighting->snapshot();
    EXPECT_TRUE(shown.overlay(4).marks.empty());
    EXPECT_FALSE(shown.overlay(4).legend.notes.empty());
}

} // namespace
} // namespace limn::skin_overlay_test
