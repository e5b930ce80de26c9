// SPDX-License-Identifier: MIT
// What a bake is expected to take and took, and bakes to an error, in the editor.
#include "editor_ui/document/document_edit.h"
#include "editor_ui/panels/action.h"
#include "tests/core/source_path.h"
#include "tests/core/temporary_folder.h"
#include "tests/editor_ui/headless.h"
#include "tests/editor_ui/small_session.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace limn::bake_panel_test {
namespace {

struct BakePanel : testing::Test {
    TemporaryFolder folder;
    Session session{SessionOptions{sourcePath("projects"), [] {}, true}};
    EditorState& state = session.state;

    void SetUp() override {
        setenv("XDG_CONFIG_HOME", folder.path.c_str(), 1);
        const std::string project = folder.file("small.limn");
        ASSERT_TRUE(saveProject(project, smallDocument()));
        session.open(project);
        ASSERT_TRUE(upToDate());
    }
    bool upToDate() {
        return runUntil(session, [&] {
            return session.idle() && state.bake.freshness == BakeFreshness::UpToDate;
        });
    }
    BakeSettings& settings() {
        for (auto& [id, object] : state.document.objects)
            if (auto* s = std::get_if<BakeSettings>(&object))
                return *s;
        throw std::runtime_error("no bake settings");
    }
    static double secondsOf(const StageSeconds& seconds, const char* stage) {
        const auto at = std::ranges::find(seconds, stage, [](const auto& s) { return s.first; });
        return at == seconds.end() ? -1 : at->second;
    }
};

TEST_F(BakePanel, ABakeIsExpectedToTakeWhatItTookWithTheSameSettings) {
    const BakeStatus& bake = state.bake;
    ASSERT_EQ(bake.measured.seconds.size(), bake.last.seconds.size());
    EXPECT_EQ(bake.expected.seconds, bake.measured.seconds);
    EXPECT_GT(bake.measured.bytes, 0);
    EXPECT_EQ(bake.expected.bytes, bake.measured.bytes);
    EXPECT_FALSE(bake.measured.update.empty()) << "relighting is measured after the bake";
    EXPECT_GT(bake.measured.updateMs, 0);
}

TEST_F(BakePanel, SlidersChangeWhatIsExpectedBeforeTheBake) {
    state.autoBake = false;
    const PrecomputedCost before = state.bake.expected;
    settings().rays *= 4;
    session.update();
    const PrecomputedCost rays = state.bake.expected;
    EXPECT_GT(secondsOf(rays.seconds, "trace"), 2 * secondsOf(before.seconds, "trace"));
    EXPECT_EQ(state.bake.measured.seconds, before.seconds);
    settings().links = 4;
    session.update();
    EXPECT_LT(state.bake.expected.bytes, before.bytes);
    EXPECT_LT(state.bake.expected.updateMs, before.updateMs);
}

// The store has all but the links of a bake whose number of links changed.
TEST_F(BakePanel, StagesThatWereKeptCostWhatTheyDidBefore) {
    const PrecomputedCost before = state.bake.measured;
    settings().links = 24;
    session.update();
    ASSERT_TRUE(runUntil(session, [&] { return state.bake.freshness != BakeFreshness::UpToDate; }));
    ASSERT_TRUE(upToDate());
    const std::vector<std::string>& kept = state.bake.last.keptStages;
    EXPECT_TRUE(std::ranges::find(kept, "trace") != kept.end());
    EXPECT_TRUE(std::ranges::find(kept, "cut") == kept.end());
    EXPECT_EQ(secondsOf(state.bake.measured.seconds, "trace"), secondsOf(before.seconds, "trace"));
    EXPECT_EQ(secondsOf(state.bake.measured.seconds, "cut"),
              secondsOf(state.bake.last.seconds, "cut"));
}

TEST_F(BakePanel, ABakeUntilTheErrorHoldsSetsItsCountsAsOneEdit) {
    state.view.camera = chooseCamera(*session.scene(), {});
    state.goals.maxError = 0.6f;
    const BakeSettings before = settings();
    runAction(state, actionById("bake.error"));
    ASSERT_TRUE(runUntil(session, [&] { return !state.bake.step.empty(); }));
    ASSERT_TRUE(runUntil(session, [&] { return !state.bake.goal.empty(); })) << state.bake.error;
    ASSERT_TRUE(upToDate()) << "no other bake follows";
    EXPECT_EQ(settings(), session.baked().bake->settings());
    EXPECT_GE(settings().lightmapCaches, kBakePresets.front().lightmapCaches);
    EXPECT_NE(state.bake.goal.find("Error 0."), std::string::npos) << state.bake.goal;
    ASSERT_EQ(state.history.edits.size(), 1U);
    undoEdit(state);
    EXPECT_EQ(settings(), before);
}

TEST_F(BakePanel, ABakeUntilTheErrorHoldsCanBeCancelled) {
    state.view.camera = chooseCamera(*session.scene(), {});
    state.goals.maxError = 0.02f;
    const auto bake = session.baked().bake;
    const Document before = state.document;
    runAction(state, actionById("bake.error"));
    ASSERT_TRUE(runUntil(session, [&] { return !state.bake.stage.empty() && state.bake.running; }));
    runAction(state, actionById("bake.cancel"));
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    EXPECT_EQ(state.bake.error, "cancelled");
    EXPECT_EQ(session.baked().bake, bake);
    EXPECT_EQ(state.document, before);
}

TEST_F(BakePanel, FitsSettingsToABudgetAsOneEdit) {
    state.view.camera = chooseCamera(*session.scene(), {});
    state.goals.budgetMs = 500;
    state.goals.budgetMiB = 6;
    state.goals.seconds = 1; // the least number of trials
    const BakeSettings before = settings();
    EXPECT_TRUE(state.goals.errors.empty());
    runAction(state, actionById("bake.budget"));
    ASSERT_TRUE(runUntil(session, [&] { return state.bake.fitting && !state.bake.step.empty(); }));
    ASSERT_TRUE(runUntil(session, [&] { return !state.bake.goal.empty(); })) << state.bake.error;
    ASSERT_TRUE(upToDate()) << "no other bake follows";
    EXPECT_EQ(settings(), session.baked().bake->settings());
    EXPECT_NE(state.bake.goal.find("error of 0."), std::string::npos) << state.bake.goal;
    EXPECT_LE(state.bake.measured.bytes, 6 * (1 << 20));
    const MeasuredError* known = nearestError(state.goals.errors, settings());
    ASSERT_NE(known, nullptr);
    EXPECT_EQ(known->settings, settings()) << "the error of what was found is known";
    ASSERT_EQ(state.history.edits.size(), 1U);
    EXPECT_EQ(state.history.edits.back().label, "Fit to budget");
    undoEdit(state);
    EXPECT_EQ(settings(), before);
}

TEST_F(BakePanel, AFitThatKeepsNoBudgetOrIsCancelledChangesNothing) {
    state.view.camera = chooseCamera(*session.scene(), {});
    state.goals.budgetMs = 1e-6f;
    state.goals.seconds = 1;
    const auto bake = session.baked().bake;
    const Document before = state.document;
    runAction(state, actionById("bake.budget"));
    ASSERT_TRUE(runUntil(session, [&] { return !state.bake.error.empty() && session.idle(); }));
    EXPECT_NE(state.bake.error.find("ms, not"), std::string::npos) << state.bake.error;
    EXPECT_EQ(session.baked().bake, bake);
    EXPECT_EQ(state.document, before);
    state.goals.budgetMs = 5;
    state.goals.seconds = 270;
    runAction(state, actionById("bake.budget"));
    ASSERT_TRUE(runUntil(session, [&] { return state.bake.running && !state.bake.stage.empty(); }));
    runAction(state, actionById("bake.cancel"));
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    EXPECT_EQ(state.bake.error, "cancelled");
    EXPECT_EQ(state.document, before);
}

TEST(MeasuredErrors, TheMostSimilarSettingsSayTheErrorIfTheyAreSimilarAtAll) {
    BakeSettings s;
    EXPECT_EQ(nearestError({}, s), nullptr);
    std::vector<MeasuredError> errors(3, {s, 0.1});
    errors[1] = {s, 0.2};
    errors[1].settings.links *= 2;
    errors[2] = {s, 0.3};
    errors[2].settings.surfels /= 2;
    errors[2].settings.links *= 2;
    EXPECT_EQ(nearestError(errors, s), &errors[0]);
    s.links *= 3;
    EXPECT_EQ(nearestError(errors, s), &errors[1]);
    s.links *= 2;
    EXPECT_EQ(nearestError(errors, s), &errors[1]) << "one and a half doublings";
    s.lightmapCaches *= 2;
    EXPECT_EQ(nearestError(errors, s), nullptr);
    errors.push_back({errors[1].settings, 0.4});
    EXPECT_EQ(nearestError(errors, errors[1].settings), &errors[3]) << "the newest";
}

TEST_F(BakePanel, IsDrawnWithEveryState) {
    HeadlessUi ui;
    for (const auto& [id, object] : state.document.objects)
        if (std::holds_alternative<BakeSettings>(object))
            state.selection = {id};
    const Document before = state.document;
    for (const BakeFreshness freshness :
         {BakeFreshness::NotUsed, BakeFreshness::None, BakeFreshness::Checking,
          BakeFreshness::UpToDate, BakeFreshness::Needed}) {
        state.bake.freshness = freshness;
        ui.frames(state);
    }
    state.bake.running = true;
    state.bake.step = "20 000 texels, after an error of 0.31";
    ui.frames(state);
    state.bake = {};
    ui.frames(state);
    EXPECT_EQ(state.document, before);
}

} // namespace
} // namespace limn::bake_panel_test
