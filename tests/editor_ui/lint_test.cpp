// SPDX-License-Identifier: MIT
// Checking a scene in the editor: the job beside it, and the list.
#include "editor_ui/panels/action.h"
#include "tests/core/source_path.h"
#include "tests/core/temporary_folder.h"
#include "tests/editor_ui/drawn_items.h"
#include "tests/editor_ui/headless.h"
#include "tests/editor_ui/small_session.h"

#include <gtest/gtest.h>

#include <imgui.h>

#include <algorithm>
#include <string>

namespace limn::lint_test {
namespace {

struct CheckingScene : testing::Test {
    TemporaryFolder folder;
    HeadlessUi ui{1280, 720};
    Session session{SessionOptions{sourcePath("projects"), [] {}, false}};
    EditorState& state = session.state;
    ObjectId dark = 0; ///< a lamp of no strength with a long name

    void open() {
        setenv("XDG_CONFIG_HOME", folder.path.c_str(), 1);
        const std::string project = folder.file("small.limn");
        Document document = smallDocument();
        dark = addObject(document, Light{.name = std::string(300, 'L'), .strength = 0});
        ASSERT_TRUE(saveProject(project, document));
        session.open(project);
        ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    }
    bool check() {
        runAction(state, actionById("bake.check"));
        ui.frames(state);
        return runUntil(session, [&] {
            ui.frames(state);
            return session.idle() && state.lint.findings;
        });
    }
    const Finding* findingOf(ObjectId object) const {
        for (const Finding& finding : *state.lint.findings)
            if (finding.object == object)
                return &finding;
        return nullptr;
    }
};

TEST_F(CheckingScene, FindsAFaultAndForgetsItOnceItIsMended) {
    open();
    ASSERT_TRUE(check()) << state.lint.error;
    EXPECT_EQ(state.layout.tab, BottomTab::Check);
    ASSERT_TRUE(findingOf(dark));
    EXPECT_EQ(findingOf(dark)->rule->name, "zero-light");
    EXPECT_FALSE(state.lint.outdated);
    std::get<Light>(state.document.objects.at(dark)).strength = 10;
    session.update();
    EXPECT_TRUE(state.lint.outdated);
    ASSERT_TRUE(check());
    EXPECT_FALSE(state.lint.outdated);
    EXPECT_FALSE(findingOf(dark));
}

TEST_F(CheckingScene, AClickOnARowSelectsItsObject) {
    DrawnItems drawn;
    open();
    ASSERT_TRUE(check()) << state.lint.error;
    state.selection.clear();
    state.lint.findings =
        std::make_shared<const std::vector<Finding>>(std::vector<Finding>{*findingOf(dark)});
    ui.frames(state);
    ui.frames(state);
    bool clicked = false;
    for (const DrawnItem& item : drawn.lastFrame())
        if (std::string(item.window->Name).find("findings") != std::string::npos && !clicked) {
            const ImVec2 middle = item.box.GetCenter();
            ui.mouse(middle.x, middle.y);
            ui.button(true);
            ui.button(false);
            ui.frames(state);
            clicked = !state.selection.empty();
        }
    EXPECT_EQ(state.selection, std::vector<ObjectId>{dark});
}

TEST_F(CheckingScene, AnEmptySceneIsOnlyDark) {
    ASSERT_TRUE(check()) << state.lint.error;
    ASSERT_EQ(state.lint.findings->size(), 1U);
    EXPECT_EQ(state.lint.findings->front().rule->name, "dark-scene");
    ui.frames(state);
}

TEST_F(CheckingScene, CanBeCancelled) {
    open();
    state.requests.push_back({Request::Kind::Lint});
    session.update();
    EXPECT_TRUE(state.lint.running);
    ui.frames(state);
    state.requests.push_back({Request::Kind::CancelLint});
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    EXPECT_TRUE(state.lint.findings || state.lint.error == "cancelled") << state.lint.error;
}

} // namespace
} // namespace limn::lint_test
