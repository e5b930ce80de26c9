// SPDX-License-Identifier: MIT
// Explaining a pixel in the editor: the click, the job beside it, and the table.
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/explain_panel.h"
#include "engine/files/project_file.h"
#include "tests/core/source_path.h"
#include "tests/core/temporary_folder.h"
#include "tests/editor_ui/headless.h"
#include "tests/editor_ui/small_session.h"

#include <gtest/gtest.h>

#include <imgui.h>

#include <algorithm>
#include <string>

namespace limn::explain_test {
namespace {

struct Explaining : testing::Test {
    TemporaryFolder folder;
    HeadlessUi ui{1280, 720};
    Session session{SessionOptions{sourcePath("projects"), [] {}, true}};
    EditorState& state = session.state;

    void SetUp() override {
        setenv("XDG_CONFIG_HOME", folder.path.c_str(), 1);
        const std::string project = folder.file("small.limn");
        Document document = smallDocument();
        for (auto& [id, object] : document.objects)
            if (auto* light = std::get_if<Light>(&object))
                light->name.assign(300, 'L');
        ASSERT_TRUE(saveProject(project, document));
        session.open(project);
        ASSERT_TRUE(runUntil(session, [&] {
            return session.idle() && session.state.bake.freshness == BakeFreshness::UpToDate;
        }));
        ui.frames(state);
        ui.frames(state);
    }
    void showTable() {
        runAction(state, actionById("view.explain"));
        ui.frames(state);
        ui.frames(state);
    }
    glm::vec2 middle() const { return state.view.origin + state.view.size / 2.f; }
    void click(glm::vec2 at) {
        ui.mouse(at.x, at.y);
        ui.button(true);
        ui.button(false);
        ui.frames(state);
    }
    bool explained() {
        return runUntil(session, [&] { return session.idle() && state.explain.result; });
    }
};

TEST_F(Explaining, AClickInThePictureExplainsThePixelWhileTheTableIsShown) {
    click(middle() + glm::vec2(0, 40));
    EXPECT_FALSE(state.explain.shown);
    EXPECT_FALSE(state.explain.pick) << "the table is hidden";
    showTable();
    EXPECT_TRUE(state.explain.shown);
    click(middle() + glm::vec2(0, 40));
    ASSERT_TRUE(state.explain.pick);
    ASSERT_TRUE(explained()) << state.explain.refusal << state.explain.error;
    const ExplainedPixel& pixel = *state.explain.result;
    EXPECT_GT(pixel.explanation.total.y, 0);
    EXPECT_EQ(pixel.lights.size(), session.scene()->lights.size());
    EXPECT_EQ(pixel.nodes.size(), session.scene()->instances.size());
    ui.frames(state); // with names longer than the window
}

TEST_F(Explaining, AnEditExplainsThePixelAnew) {
    showTable();
    click(middle() + glm::vec2(0, 40));
    ASSERT_TRUE(explained());
    const auto before = state.explain.result;
    for (auto& [id, object] : state.document.objects)
        if (auto* light = std::get_if<Light>(&object))
            light->strength *= 2;
    ASSERT_TRUE(
        runUntil(session, [&] { return session.idle() && state.explain.result != before; }));
    float lamp = 0;
    for (const LightRow& row : before->explanation.tables.byOrigin)
        if (row.kind == LightRowKind::Light)
            lamp += row.value.y;
    EXPECT_GT(lamp, 0);
    EXPECT_NEAR(state.explain.result->explanation.total.y - before->explanation.total.y, lamp,
                0.02 * lamp);
    const auto after = state.explain.result;
    for (int i = 0; i < 20; ++i)
        session.update();
    EXPECT_TRUE(session.idle());
    EXPECT_EQ(state.explain.result, after) << "nothing has changed";
}

TEST_F(Explaining, ARowUnderTheMouseMarksItsObjectAndAClickSelectsIt) {
    showTable();
    click(middle() + glm::vec2(0, 40));
    ASSERT_TRUE(explained());
    state.selection.clear();
    const auto& rows = state.explain.result->explanation.tables.byOrigin;
    ASSERT_TRUE(
        std::ranges::any_of(rows, [](const LightRow& r) { return r.kind == LightRowKind::Light; }));
    ObjectId marked = 0;
    // The rows lie in the panel at the bottom.
    for (float y = state.view.origin.y + state.view.size.y; y < 720 && marked == 0; y += 4) {
        ui.mouse(100, y);
        ui.frames(state);
        marked = state.explain.hovered;
    }
    ASSERT_NE(marked, 0U);
    EXPECT_TRUE(std::holds_alternative<Light>(state.document.objects.at(marked)));
    ui.button(true);
    ui.button(false);
    ui.frames(state);
    EXPECT_EQ(activeId(state), marked);
    ui.mouse(middle().x, middle().y);
    ui.frames(state);
    EXPECT_EQ(state.explain.hovered, 0U);
}

TEST_F(Explaining, MutingALightShowsThePictureWithoutItAndKeepsTheTable) {
    showTable();
    click(middle() + glm::vec2(0, 40));
    ASSERT_TRUE(explained());
    const auto before = state.explain.result;
    const std::size_t light = 0;
    ASSERT_TRUE(session.scene()->lights[light].enabled);
    state.explain.muted = {before->lights[light]};
    ui.frames(state);
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    EXPECT_FALSE(session.scene()->lights[light].enabled);
    EXPECT_EQ(state.bake.freshness, BakeFreshness::UpToDate);
    EXPECT_EQ(state.explain.result, before) << "the table still has the light";
    EXPECT_TRUE(std::get<Light>(state.document.objects.at(before->lights[light])).enabled);
    // Another tab shows the whole picture again.
    state.explain.mutes = false;
    session.update();
    EXPECT_TRUE(session.scene()->lights[light].enabled);
}

TEST_F(Explaining, MutingAnObjectBlackensItAndNoOtherOfItsMaterial) {
    showTable();
    const std::shared_ptr<const Scene> whole = session.scene();
    const Instance& first = whole->instances.front();
    state.explain.muted = {first.node};
    ui.frames(state);
    session.update();
    const Scene& scene = *session.scene();
    ASSERT_EQ(scene.instances.size(), whole->instances.size());
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Material& now = scene.materialOf(scene.instances[i]);
        const Material& then = whole->materialOf(whole->instances[i]);
        if (scene.instances[i].node == first.node)
            EXPECT_EQ(glm::vec3(now.baseColor), glm::vec3(0)) << i;
        else
            EXPECT_EQ(now, then) << i;
    }
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    EXPECT_EQ(state.bake.freshness, BakeFreshness::UpToDate) << "a bake reads no colours";
}

TEST_F(Explaining, TheEyeOfARowMutesItAndShowsItAgain) {
    showTable();
    click(middle() + glm::vec2(0, 40));
    ASSERT_TRUE(explained());
    ui.frames(state);
    const auto muteNext = [&](bool wanted) {
        // The eyes are the last column of the panel at the bottom.
        for (float y = state.view.origin.y + state.view.size.y; y < 720; y += 3)
            for (float x = 1270; x > 1180; x -= 8) {
                ui.mouse(x, y);
                ui.frames(state);
                click({x, y});
                if (state.explain.muted.empty() != wanted)
                    return true;
            }
        return false;
    };
    ASSERT_TRUE(muteNext(true));
    EXPECT_EQ(state.explain.muted.size(), 1U);
    ASSERT_TRUE(muteNext(false));
}

} // namespace
} // namespace limn::explain_test
