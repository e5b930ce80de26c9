// SPDX-License-Identifier: MIT
#include "engine/measure/bake_to_error.h"

#include "engine/core/process_memory.h"
#include "engine/techniques/technique_table.h"
#include "tests/techniques/illuminance/relight/lit_room.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

namespace limn::bake_to_error_test {
namespace {

const Technique& kBaking = precomputingTechnique({});

ErrorGoal goal(const Scene& scene, double nrmse) {
    return {nrmse, chooseCamera(scene, {})};
}

/// Collects the texel count and the error of each bake that is made.
struct Way {
    std::vector<std::uint32_t> texels;
    std::vector<double> error;

    void operator()(const MeasuredBake& made) {
        texels.push_back(made.bake->settings().lightmapCaches);
        error.push_back(made.error.nrmse);
    }
};

TEST(BakeToError, GrowsUntilTheErrorIsHeld) {
    const Scene scene = *litRoom(100, 60);
    const TraceScene trace(scene);
    Way way;
    const auto first = bakeToError(kBaking, trace, goal(scene, 10), {}, nullptr, {}, std::ref(way));
    ASSERT_TRUE(first) << first.error().message;
    ASSERT_EQ(way.texels, std::vector<std::uint32_t>{60}) << "any error will do";
    ASSERT_GT(first->error.nrmse, 0.01);
    way = {};
    const double half = first->error.nrmse / 2;
    const auto held =
        bakeToError(kBaking, trace, goal(scene, half), {}, nullptr, {}, std::ref(way));
    ASSERT_TRUE(held) << held.error().message;
    EXPECT_EQ(held->end, MeasuredBake::End::Held);
    EXPECT_LE(held->error.nrmse, half);
    ASSERT_GE(way.texels.size(), 2U);
    EXPECT_EQ(way.texels[1], 120U);
    EXPECT_EQ(held->bake->settings().lightmapCaches, way.texels.back());
    EXPECT_EQ(way.error.front(), first->error.nrmse) << "the same points";
}

TEST(BakeToError, EndsWhereMoreTexelsAreOfNoUse) {
    Scene scene = *litRoom(400, 400);
    scene.relight.maxBounces = 1; // whatever the texels: the light of the other bounces is missing
    const TraceScene trace(scene);
    const auto made = bakeToError(kBaking, trace, goal(scene, 1e-3));
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(made->end, MeasuredBake::End::NoBetter);
    EXPECT_LT(made->error.bias, -0.01);
}

TEST(BakeToError, EndsWhereMemoryDoes) {
    const Scene scene = *litRoom(4000, 4000);
    const TraceScene trace(scene);
    MemoryBudget memory{.maxBytes = residentMemory() +
                                    kBaking.precomputation->predict(scene, false).working +
                                    (1 << 20)};
    const auto made = bakeToError(kBaking, trace, goal(scene, 1e-4), {}, nullptr, memory);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(made->end, MeasuredBake::End::Memory);
    EXPECT_EQ(made->bake->settings().lightmapCaches, 4000U);
    memory.maxBytes = 1;
    const auto none = bakeToError(kBaking, trace, goal(scene, 1e-4), {}, nullptr, memory);
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("--memory"), std::string::npos) << none.error().message;
}

TEST(BakeToError, FailsInTheDarkAndWhenCancelled) {
    Scene scene = *litRoom(100, 60);
    std::atomic<bool> cancel = true;
    EXPECT_FALSE(bakeToError(kBaking, TraceScene(scene), goal(scene, 1), {.cancel = &cancel}));
    scene.lights.clear();
    for (Material& m : scene.materials)
        m = simple::lambert(glm::vec3(0.05f)); // paths of few bounces
    scene.sky = {};
    const auto dark = bakeToError(kBaking, TraceScene(scene), goal(scene, 1));
    ASSERT_FALSE(dark);
    EXPECT_EQ(dark.error().message, "the camera sees no light, so no error is known");
}

TEST(FinerSettings, LeadThroughTheCountsOfThePresets) {
    BakeSettings s;
    kBakePresets[0].applyTo(s);
    for (int i = 0; i < 4; ++i)
        s = finerSettings(s);
    const BakePreset& high = kBakePresets[2];
    EXPECT_EQ(s.lightmapCaches, high.lightmapCaches);
    EXPECT_NEAR(double(s.surfels), high.surfels, 0.01 * high.surfels);
    EXPECT_NEAR(double(s.links), high.links, 1);
    EXPECT_NEAR(double(s.rays), high.rays, 0.01 * high.rays);
    for (int i = 0; i < 40; ++i)
        s = finerSettings(s);
    EXPECT_EQ(finerSettings(s), s);
}

} // namespace
} // namespace limn::bake_to_error_test
