// SPDX-License-Identifier: MIT
#include "engine/lighting/lighting_driver.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace limn::lighting_driver_test {
namespace {

/// Converges after so many bounces, and lights only what is seen where there is a view.
struct FakeLighting : Lighting {
    struct Call {
        std::uint32_t bounces;
        bool view;
        bool operator==(const Call&) const = default;
    };
    std::vector<Call>& calls;
    std::uint32_t needed;
    std::uint32_t done = 0;
    int unsolved = 0; ///< steps of solveSources()
    bool ofView = false;

    FakeLighting(std::vector<Call>& to, std::uint32_t bounces) : calls(to), needed(bounces) {}
    LightingReport update(const LightingInput& input, const Progress&) override {
        calls.push_back({input.bounces, input.view != nullptr});
        LightingReport report;
        report.bounces = input.bounces;
        done += input.bounces;
        report.converged = done >= needed;
        report.whole = input.view == nullptr;
        return report;
    }
    bool solveSources(const LightingInput&, const Progress&) override { return --unsolved > 0; }
    const IndirectField* field() const override { return nullptr; }
    bool isOfView() const override { return ofView; }
};

struct LightingDriverTest : testing::Test {
    using Rest = LightingDriver::Rest;
    using Calls = std::vector<FakeLighting::Call>;

    Scene scene;
    Viewpoint view;
    Calls calls;

    LightingDriver driver(std::uint32_t needed) {
        return LightingDriver(std::make_unique<FakeLighting>(calls, needed));
    }
    LightingInput input() const { return {.scene = scene, .view = &view}; }
};

TEST_F(LightingDriverTest, LightsAllOnceThenWhatIsSeenAndTheRestWhenItHasConverged) {
    LightingDriver d = driver(4);
    EXPECT_FALSE(d.done());
    EXPECT_TRUE(d.step(input(), Rest::All));
    EXPECT_TRUE(d.step(input(), Rest::All));
    EXPECT_TRUE(d.converged());
    EXPECT_FALSE(d.step(input(), Rest::All)) << "a rest tells nothing of bounces";
    EXPECT_TRUE(d.done());
    EXPECT_EQ(d.bounces(), 4U);
    // The first update took no heed of the view, so that there is light everywhere.
    EXPECT_EQ(calls, (Calls{{2, false}, {2, true}, {0, false}}));
    EXPECT_FALSE(d.step(input(), Rest::All)) << "nothing is left to do";
}

TEST_F(LightingDriverTest, TheRestIsLitByViewOrWholeOrLater) {
    LightingDriver d = driver(2);
    d.step(input(), Rest::All);
    ASSERT_TRUE(d.done());
    d.lightChanged();
    EXPECT_EQ(d.bounces(), 0U);
    calls.clear();
    EXPECT_TRUE(d.step(input(), Rest::All));
    EXPECT_TRUE(d.converged());
    EXPECT_FALSE(d.done()) << "what the view does not show has older light";
    EXPECT_FALSE(d.step(input(), Rest::Later));
    EXPECT_FALSE(d.step(input(), Rest::Seen));
    EXPECT_FALSE(d.done());
    EXPECT_FALSE(d.step(input(), Rest::All));
    EXPECT_TRUE(d.done());
    EXPECT_EQ(calls, (Calls{{2, true}, {0, true}, {0, false}}));
    EXPECT_EQ(d.bounces(), 2U);
}

TEST_F(LightingDriverTest, TakesNoMoreBouncesThanTheDocumentAsksFor) {
    scene.relight.maxBounces = 3; // few: all at once
    LightingDriver few = driver(100);
    few.step(input(), Rest::All);
    EXPECT_TRUE(few.done());
    EXPECT_EQ(calls, (Calls{{3, false}}));
    calls.clear();
    scene.relight.maxBounces = 10;
    LightingDriver many = driver(100);
    while (!many.done())
        many.step(input(), Rest::All);
    EXPECT_EQ(many.bounces(), 10U);
}

TEST_F(LightingDriverTest, LightOfAViewIsLitForItAloneAndAnewForAnotherOne) {
    auto lighting = std::make_unique<FakeLighting>(calls, 0);
    lighting->ofView = true;
    LightingDriver d(std::move(lighting));
    view.size = {32, 18};
    EXPECT_TRUE(d.step(input(), Rest::All));
    EXPECT_TRUE(d.done()) << "no rest is asked for";
    d.viewIs(view);
    EXPECT_TRUE(d.done()) << "the same view";
    EXPECT_EQ(calls, (Calls{{2, true}})) << "the first update has the view, too";
    view.size.x = 64;
    d.viewIs(view);
    EXPECT_FALSE(d.done());
    EXPECT_EQ(d.bounces(), 0U);
    EXPECT_TRUE(d.step(input(), Rest::All));
    view.camera.eye.x += 1;
    EXPECT_TRUE(d.step(input(), Rest::All)) << "step() looks at its view itself";
    EXPECT_TRUE(d.done());
    EXPECT_EQ(calls, (Calls{{2, true}, {2, true}, {2, true}}));
}

TEST_F(LightingDriverTest, AnotherViewIsNoChangeOfLightThatIsOfNone) {
    LightingDriver d = driver(2);
    d.step(input(), Rest::All);
    ASSERT_TRUE(d.done());
    view.camera.eye.x += 1;
    d.viewIs(view);
    EXPECT_TRUE(d.done());
}

TEST_F(LightingDriverTest, SolvesSourcesOnlyAtRestAndUntilNoneIsLeft) {
    auto lighting = std::make_unique<FakeLighting>(calls, 2);
    const FakeLighting& fake = *lighting;
    lighting->unsolved = 3;
    LightingDriver d(std::move(lighting));
    EXPECT_FALSE(d.canSolve());
    d.solveSources(input());
    EXPECT_EQ(fake.unsolved, 3) << "it still has bounces to add";
    d.step(input(), Rest::All);
    ASSERT_TRUE(d.done());
    for (int left = 2; left >= 0; --left) {
        EXPECT_TRUE(d.canSolve());
        d.solveSources(input());
        EXPECT_EQ(fake.unsolved, left);
    }
    EXPECT_FALSE(d.canSolve());
    d.lightChanged();
    d.step(input(), Rest::All);
    EXPECT_FALSE(d.canSolve()) << "the rest is not lit yet";
    d.step(input(), Rest::All);
    EXPECT_TRUE(d.canSolve()) << "other light may have other sources";
}

TEST_F(LightingDriverTest, WithoutALightingThereIsNothingToDo) {
    LightingDriver none;
    EXPECT_FALSE(none.canSolve());
    EXPECT_TRUE(none.done());
    EXPECT_FALSE(none.step(input(), Rest::All));
}

} // namespace
} // namespace limn::lighting_driver_test
