// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/baked_illuminance.h"

#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "tests/trace/simple_scene.h"

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

namespace limn::baked_illuminance_test {
namespace {

std::string sizeClassOf(std::size_t links) {
    Bake bake;
    bake.caches.links.resize(links);
    return BakedIlluminance(std::make_shared<const Bake>(std::move(bake))).sizeClass();
}

TEST(BakedIlluminance, TimesCarryOverToBakesOfAboutAsManyLinks) {
    EXPECT_EQ(sizeClassOf(1000), sizeClassOf(1001));
    EXPECT_NE(sizeClassOf(1000), sizeClassOf(4000));
}

/// A closed room with a few thousand caches.
Scene room(float emission = 0) {
    using namespace simple;
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f), glm::vec3(emission)));
    b.add(box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    Scene scene = b.build();
    scene.bake.surfels = 1000;
    scene.bake.lightmapCaches = 2000;
    scene.bake.rays = 128;
    scene.bake.links = 16;
    return scene;
}

std::shared_ptr<const BakedIlluminance> bakeOf(const Scene& scene, StageStore* store = nullptr) {
    Result<Bake> baked = bake(TraceScene(scene), {}, store);
    EXPECT_TRUE(baked);
    return std::make_shared<BakedIlluminance>(std::make_shared<const Bake>(std::move(*baked)));
}

const PrecomputedCost kMeasured = {.seconds = {{"surfels", 1}, {"trace", 2}, {"cut", 3}},
                                   .bytes = 1000,
                                   .update = {{"cache_light", "", "", 4}, {"field", "", "", 5}},
                                   .updateMs = 9};

double secondsOf(const PrecomputedCost& cost, const char* stage) {
    return std::ranges::find(cost.seconds, stage, [](const auto& s) { return s.first; })->second;
}

TEST(BakedIlluminance, IsExpectedToCostWhatItDidWithTheSameSettings) {
    const Scene scene = room();
    const PrecomputedCost cost = bakeOf(scene)->expectedCost(scene, scene.bake, kMeasured);
    EXPECT_EQ(cost.seconds, kMeasured.seconds);
    EXPECT_EQ(cost.bytes, kMeasured.bytes);
    EXPECT_EQ(cost.updateMs, kMeasured.updateMs);
}

// A setting changes only those costs that depend on it.
TEST(BakedIlluminance, IsExpectedToCostMoreWithMoreOfEachSetting) {
    const Scene scene = room();
    const auto baked = bakeOf(scene);
    const auto with = [&](const std::function<void(BakeSettings&)>& change) {
        BakeSettings wanted = scene.bake;
        change(wanted);
        return baked->expectedCost(scene, wanted, kMeasured);
    };
    const PrecomputedCost rays = with([](auto& s) { s.rays *= 2; });
    EXPECT_GT(secondsOf(rays, "trace"), 1.5 * 2);
    EXPECT_DOUBLE_EQ(secondsOf(rays, "surfels"), 1);
    EXPECT_NEAR(rays.bytes, 1000, 100);
    const PrecomputedCost surfels = with([](auto& s) { s.surfels *= 2; });
    EXPECT_GT(secondsOf(surfels, "surfels"), 1.8);
    EXPECT_LT(secondsOf(surfels, "trace"), 1.2 * 2);
    const PrecomputedCost texels = with([](auto& s) { s.lightmapCaches *= 2; });
    EXPECT_NEAR(secondsOf(texels, "trace"), 2 * 2, 0.2);
    EXPECT_NEAR(texels.update[0].ms, 2 * 4, 0.4);
    const PrecomputedCost bands = with([](auto& s) { s.bands = 2; });
    EXPECT_DOUBLE_EQ(bands.bytes, 1000) << "links are cones";
    EXPECT_LT(bands.updateMs, kMeasured.updateMs);
    EXPECT_DOUBLE_EQ(totalOf(bands.seconds), totalOf(kMeasured.seconds));
    const PrecomputedCost more = with([](auto& s) { s.bands = 5; });
    EXPECT_DOUBLE_EQ(more.updateMs, kMeasured.updateMs) << "no surface needs more than three bands";
}

// Bakes of fewer than 128 rays do not look for places where lamps need finer texels.
TEST(BakedIlluminance, ALampCostsTimeForChartsUnlessRaysAreFew) {
    const PrecomputedCost measured{.seconds = {{"charts", 1}}};
    for (const float emission : {0.f, 1.f}) {
        const Scene scene = room(emission);
        BakeSettings few = scene.bake;
        few.rays = 64;
        const PrecomputedCost cost = bakeOf(scene)->expectedCost(scene, few, measured);
        EXPECT_LT(secondsOf(cost, "charts"), emission > 0 ? 0.5 : 1.001);
        EXPECT_GT(secondsOf(cost, "charts"), emission > 0 ? 0.1 : 0.999);
    }
}

TEST(BakedIlluminance, BytesAreExpectedFromABakeWithOtherSettings) {
    Scene scene = room();
    const auto baked = bakeOf(scene);
    const PrecomputedCost measured{.bytes = totalOf(baked->report().bytes)};
    Scene other = scene;
    other.bake.lightmapCaches = 5000;
    other.bake.links = 32;
    const double real = totalOf(bakeOf(other)->report().bytes);
    EXPECT_NEAR(baked->expectedCost(scene, other.bake, measured).bytes, real, 0.15 * real);
}

TEST(BakedIlluminance, NamesTheStagesThatTheStoreHeld) {
    Scene scene = room();
    StageStore store;
    EXPECT_TRUE(bakeOf(scene, &store)->report().keptStages.empty());
    scene.bake.links = 24;
    const std::vector<std::string> kept = bakeOf(scene, &store)->report().keptStages;
    const auto isKept = [&](const char* stage) { return std::ranges::count(kept, stage) == 1; };
    EXPECT_TRUE(isKept("trace"));
    EXPECT_TRUE(isKept("caches"));
    EXPECT_FALSE(isKept("cut"));
}

} // namespace
} // namespace limn::baked_illuminance_test
