// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/editor_settings.h"
#include "editor_ui/jobs/settings_job.h"

#include "editor_ui/panels/overlay_panel.h"
#include "engine/techniques/technique_table.h"
#include "tests/core/source_path.h"
#include "tests/core/temporary_folder.h"
#include "tests/editor_ui/headless.h"
#include "tests/editor_ui/small_session.h"

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <imgui.h>

namespace limn::editor_settings_test {
namespace {

EditorSettings unusual() {
    WorkspaceStates workspaces = defaultWorkspaces();
    workspaces[1] = {.layout = {300, 400, 100, true, BottomTab::Log},
                     .overlay = overlayKinds().front()->name,
                     .compare = Compare::Flip};
    return {.workspace = Workspace::Bake,
            .workspaces = workspaces,
            .closedCards = {"Transform"},
            .view = View::Irradiance,
            .tonemap = Tonemap::Agx,
            .exposureEv = -2.5f,
            .autoExposure = true,
            .physical = {2.8f, 400},
            .showLights = false,
            .lightTheme = true,
            .gizmo = {.space = GizmoSpace::View,
                      .snap = true,
                      .moveStep = 0.25f,
                      .rotateStep = 5,
                      .scaleStep = 0.5f,
                      .blenderKeys = true},
            .autoBake = false,
            .keys = {{"edit.undo", {key::of('U'), kAlt}}, {"edit.redo", {}}}};
}

TEST(EditorSettings, AreReadAsTheyWereWritten) {
    EXPECT_EQ(settingsFromJson(settingsToJson(unusual())), unusual());
    EXPECT_EQ(settingsFromJson(settingsToJson({})), EditorSettings{});
    EditorState state = fullEditor();
    useSettings(state, unusual());
    EXPECT_EQ(settingsOf(state), unusual());
}

TEST(EditorSettings, AnyTextGivesUsableOnes) {
    const EditorSettings usual;
    for (const std::string& text :
         {std::string(), std::string("{"), std::string("null"), std::string("[1]"),
          std::string(100000, '['), std::string("{\"workspaces\": {\"light\": {\"left\": 1e999}}}"),
          std::string("{\"workspaces\": {\"bake\": {\"left\": -1, \"right\": 1e30}}}"),
          std::string("{\"workspaces\": {\"light\": {\"bottom\": \"12\", \"bottomOpen\": 1}}}"),
          std::string("{\"workspaces\": {\"light\": {\"tab\": \"none such\", \"compare\": 3}}}"),
          std::string("{\"workspaces\": [], \"workspace\": \"none such\", \"closedCards\": 1}"),
          std::string("{\"workspaces\": {\"light\": 3}, \"exposure\": 21}"),
          std::string("{\"view\": 3, \"tonemap\": \"\"}"),
          std::string("{\"lightIcons\": 0, \"bakeWhenNeeded\": \"no\", \"other\": {}}"),
          std::string("{\"moveStep\": -1, \"rotateStep\": 0, \"scaleStep\": 0, \"snap\": 1}"),
          std::string(
              "{\"keys\": {\"edit.undo\": 3, \"none.such\": \"A\", \"file.open\": \"Ctrl-\"}}"),
          std::string("{\"keys\": {\"edit.undo\": \"Esc\", \"edit.redo\": \"\xff\"}}"),
          std::string("{\"view\": \"\xff\xfe\"}")})
        EXPECT_EQ(settingsFromJson(text), usual) << text.substr(0, 80);
    const std::string good = settingsToJson(unusual());
    for (std::size_t end = 0; end < good.size() - 2; ++end)
        EXPECT_EQ(settingsFromJson(good.substr(0, end)), usual) << end;
}

TEST(EditorSettings, OutliveTheEditorAndTheDocument) {
    const TemporaryFolder folder;
    setenv("XDG_CONFIG_HOME", folder.path.c_str(), 1);
    const SessionOptions options{.projectsFolder = sourcePath("projects"),
                                 .wake = [] {},
                                 .bakeOnOpen = false,
                                 .settingsFile = folder.file("new/editor.json")};
    {
        Session session(options);
        EXPECT_EQ(settingsOf(session.state), EditorSettings{});
        useSettings(session.state, unusual());
        session.open("cornell");
        ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
        EXPECT_EQ(settingsOf(session.state), unusual()) << "another document";
        session.state.requests.push_back({Request::Kind::Quit, {}});
        session.update();
        ASSERT_TRUE(session.wantsQuit());
    }
    EXPECT_EQ(settingsOf(Session(options).state), unusual());
}

// A crash loses at most the last second's settings.
TEST(EditorSettings, AreWrittenSoonAfterTheyChange) {
    const TemporaryFolder folder;
    const std::string file = folder.file("editor.json");
    SettingsJob job(file, {});
    job.keep({});
    job.keep(unusual());
    for (int i = 0; i < 6000 && readEditorSettings(file) != unusual(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(readEditorSettings(file), unusual());
}

TEST(EditorSettings, OfTheLastSecondAreWrittenWhenTheEditorEnds) {
    const TemporaryFolder folder;
    const std::string file = folder.file("editor.json");
    {
        SettingsJob job(file, {});
        job.keep(unusual());
    }
    EXPECT_EQ(readEditorSettings(file), unusual());
}

// A window that is small for a while does not cost the user's panels.
TEST(EditorSettings, PanelsGetTheirSizesBackInALargerWindow) {
    HeadlessUi ui(1280, 800);
    EditorState state = fullEditor();
    ui.frames(state);
    const LayoutState before = state.layout;
    const glm::vec2 picture = state.view.size;
    for (const ImVec2 size : {ImVec2(320, 240), ImVec2(1, 1), ImVec2(1280, 800)}) {
        ImGui::GetIO().DisplaySize = size;
        ui.frames(state);
    }
    EXPECT_EQ(state.layout, before);
    EXPECT_EQ(state.view.size, picture);
}

// At 192 dpi a window of twice the pixels looks as it does at 96.
TEST(EditorSettings, PanelsAreAsLargeAsTheirTextAtAnyDensity) {
    glm::vec2 usual, dense;
    {
        HeadlessUi ui(1280, 800);
        EditorState state = fullEditor();
        ui.frames(state);
        usual = state.view.size;
    }
    {
        HeadlessUi ui(2560, 1600, 2);
        EditorState state = fullEditor();
        ui.frames(state);
        dense = state.view.size;
    }
    EXPECT_NEAR(dense.x, 2 * usual.x, 8); // borders and rounding
    EXPECT_NEAR(dense.y, 2 * usual.y, 8);
}

} // namespace
} // namespace limn::editor_settings_test
