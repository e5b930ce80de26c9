// SPDX-License-Identifier: MIT
// Places that are to have some light: how they are set, and the strengths that are solved for.
#include "editor_ui/document/document_edit.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/goals_panel.h"
#include "engine/math/luminance.h"
#include "tests/core/source_path.h"
#include "tests/core/temporary_folder.h"
#include "tests/editor_ui/headless.h"
#include "tests/editor_ui/small_session.h"

#include <gtest/gtest.h>

#include <imgui.h>

namespace limn::goals_test {
namespace {

struct Solving : testing::Test {
    TemporaryFolder folder;
    HeadlessUi ui{1280, 720};
    Session session{SessionOptions{sourcePath("projects"), [] {}, true}};
    EditorState& state = session.state;
    GoalsState& goals = state.explain.goals;

    void SetUp() override {
        setenv("XDG_CONFIG_HOME", folder.path.c_str(), 1);
        const std::string project = folder.file("small.limn");
        Document document = smallDocument();
        addObject(document, Light{.name = "Other", .position = {-0.5f, 1, 0.3f}, .strength = 2});
        ASSERT_TRUE(saveProject(project, document));
        session.open(project);
        ASSERT_TRUE(runUntil(session, [&] {
            return session.idle() && session.state.bake.freshness == BakeFreshness::UpToDate;
        }));
        state.layout.bottomOpen = true;
        state.layout.tab = BottomTab::Lights;
        ui.frames(state);
        ui.frames(state);
    }

    /// Clicks below the middle of the picture, and waits for the explanation.
    bool clickFloor() {
        const glm::vec2 middle = state.view.origin + state.view.size / 2.f;
        ui.mouse(middle.x, middle.y + 40);
        ui.button(true);
        ui.button(false);
        ui.frames(state);
        return runUntil(session, [&] { return session.idle() && state.explain.result; });
    }

    /// Presses every place of the panel at the bottom until `done`.
    bool press(const std::function<bool()>& done) {
        for (float y = state.view.origin.y + state.view.size.y; y < 715; y += 6)
            for (float x = 700; x < 1270; x += 12) {
                ui.mouse(x, y);
                ui.button(true);
                ui.button(false);
                ui.frames(state);
                if (done())
                    return true;
            }
        return false;
    }

    float strengthOf(const char* name) const {
        return std::get<Light>(state.document.objects.at(idNamed(state, name))).strength;
    }
    bool solve() {
        goals.start = true;
        session.update();
        return runUntil(session, [&] { return session.idle() && !goals.start; });
    }
    double now() const { return luminance(glm::dvec3(state.explain.result->explanation.total)); }
};

TEST_F(Solving, FindsStrengthsAsOneStepToUndo) {
    ASSERT_TRUE(clickFloor());
    ASSERT_TRUE(press([&] { return !goals.goals.empty(); })) << "there is a button";
    ASSERT_EQ(goals.goals.size(), 1U);
    EXPECT_NEAR(goals.goals[0].now, now(), 1e-9);
    EXPECT_NEAR(goals.goals[0].wanted, now(), 1e-4 * now());
    const double wanted = 2.5 * now();
    goals.goals[0].wanted = float(wanted);
    const Document before = state.document;
    const std::size_t edits = state.history.edits.size();
    const auto explained = state.explain.result;
    const auto solves = [&] {
        goals.goals.resize(1); // the other button was pressed, too
        return goals.start;
    };
    ASSERT_TRUE(press(solves)) << "there is a button";
    ASSERT_TRUE(runUntil(session, [&] {
        return session.idle() && !goals.start && state.explain.result != explained;
    }));
    EXPECT_EQ(goals.error, "");
    EXPECT_GT(strengthOf("Lamp"), 1);
    EXPECT_GT(strengthOf("Other"), 2);
    EXPECT_NEAR(*goals.goals[0].solved, wanted, 1e-3 * wanted);
    EXPECT_NEAR(now(), wanted, 0.01 * wanted) << "the picture has the light";
    EXPECT_EQ(state.history.edits.size(), edits + 1);
    undo(state.history, state.document);
    EXPECT_EQ(state.document.objects, before.objects);
}

TEST_F(Solving, ChangesSelectedLightsAlone) {
    ASSERT_TRUE(clickFloor());
    goals.goals.push_back({.pick = *state.explain.pick, .wanted = float(2 * now())});
    goals.selectedOnly = true;
    state.selection = {idNamed(state, "Other")};
    ASSERT_TRUE(solve());
    EXPECT_EQ(goals.error, "");
    EXPECT_EQ(strengthOf("Lamp"), 1);
    EXPECT_GT(strengthOf("Other"), 2);
}

TEST_F(Solving, SaysWhyNothingWasFound) {
    ASSERT_TRUE(clickFloor());
    goals.goals.push_back({.pick = *state.explain.pick, .wanted = 3});
    goals.selectedOnly = true;
    const Document before = state.document;
    ASSERT_TRUE(solve());
    EXPECT_EQ(goals.error, "none of the lights that may change reaches a goal");
    EXPECT_EQ(state.document, before);
    ui.frames(state);
}

} // namespace
} // namespace limn::goals_test
