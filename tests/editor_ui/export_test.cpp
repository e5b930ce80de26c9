// SPDX-License-Identifier: MIT
// Exporting from the editor: the dialog, the job beside it, and what the document remembers.
#include "editor_ui/document/document_edit.h"
#include "editor_ui/panels/action.h"
#include "engine/files/document_json.h"
#include "engine/files/image_file.h"
#include "engine/files/project_file.h"
#include "tests/core/source_path.h"
#include "tests/core/temporary_folder.h"
#include "tests/editor_ui/headless.h"
#include "tests/editor_ui/small_session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

namespace limn::export_test {
namespace {

struct Exporting : testing::Test {
    TemporaryFolder folder;
    std::string project = folder.file("small.limn");

    void SetUp() override {
        setenv("XDG_CONFIG_HOME", folder.path.c_str(), 1);
        ASSERT_TRUE(saveProject(project, smallDocument()));
    }
    static SessionOptions options(bool bakes = true) {
        return {sourcePath("projects"), [] {}, bakes};
    }
    void openBaked(Session& session) {
        session.open(project);
        ASSERT_TRUE(runUntil(session, [&] {
            return session.idle() && session.state.bake.freshness == BakeFreshness::UpToDate;
        }));
    }
    static void order(Session& session, const ExportSettings& settings, const std::string& path) {
        setExportSettings(session.state, settings);
        session.state.requests.push_back({Request::Kind::Export, path});
        session.update();
    }
};

TEST_F(Exporting, WritesTheLightThatTheDocumentAsksForAndSaysSo) {
    Session session(options());
    openBaked(session);
    const std::string path = folder.file("light.exr");
    order(session, {.format = "lightmap", .quality = LightmapQuality::Draft, .detail = 1}, path);
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    EXPECT_TRUE(session.state.exporting.error.empty()) << session.state.exporting.error;
    EXPECT_NE(session.state.exporting.written.find("1 file"), std::string::npos);
    const Result<ImageF> image = readFloatImage(path);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->width, session.layout()->width);
    EXPECT_TRUE(std::ranges::all_of(image->rgb, [](glm::vec3 e) { return e.y > 0; }));
}

TEST_F(Exporting, ReportsWhyItFailed) {
    Session session(options());
    openBaked(session);
    order(session, {.format = "lightmap"}, folder.file("no/such/light.png"));
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    EXPECT_NE(session.state.exporting.error.find("must end in"), std::string::npos);
    EXPECT_TRUE(session.state.exporting.written.empty());
}

TEST_F(Exporting, ACancelledOneLeavesNoFile) {
    Session session(options());
    openBaked(session);
    const std::string path = folder.file("light.exr");
    order(session, {.format = "lightmap", .direct = true, .detail = 9}, path);
    session.state.requests.push_back({Request::Kind::CancelExport, {}});
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    EXPECT_EQ(session.state.exporting.error, "cancelled");
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(Exporting, IsRefusedWithoutABake) {
    Session session(options(false));
    session.open(project);
    ASSERT_TRUE(runUntil(session, [&] { return session.idle() && session.state.trace; }));
    openExportDialog(session.state);
    session.update();
    EXPECT_NE(session.state.exporting.refusal.find("bake"), std::string::npos);
}

TEST_F(Exporting, ItsForecastCountsTheGridThatWillBeWritten) {
    Document document = smallDocument();
    for (auto& [id, object] : document.objects)
        if (auto* settings = std::get_if<BakeSettings>(&object))
            settings->grid = {6, 5, 7};
    ASSERT_TRUE(saveProject(project, document));
    Session session(options());
    openBaked(session);
    openExportDialog(session.state);
    session.state.exportDialog->settings.format = "grid";
    session.update();
    const auto forecast = double(session.state.exporting.forecast.bytes);
    session.state.exportDialog.reset();
    const std::string path = folder.file("air.json");
    order(session, {.format = "grid"}, path);
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    ASSERT_TRUE(session.state.exporting.error.empty()) << session.state.exporting.error;
    const auto texture = double(std::filesystem::file_size(folder.file("air.ktx2")));
    EXPECT_GT(texture, 8 * 6 * 5 * 7 * 7);
    EXPECT_NEAR(forecast, texture, 0.1 * texture);
}

TEST_F(Exporting, ItsSettingsAreSavedInTheProjectAndUndone) {
    Session session(options(false));
    session.open(project);
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    const Document before = session.state.document;
    const ExportSettings settings{.format = "lightmap", .direct = true, .detail = 5};
    setExportSettings(session.state, settings);
    setExportSettings(session.state, settings);
    EXPECT_EQ(session.state.history.applied, 1U);
    const std::string saved = folder.file("saved.limn");
    ASSERT_TRUE(saveProject(saved, session.state.document));
    EXPECT_EQ(singleton<ExportSettings>(loadProject(saved)->document), settings);
    ASSERT_TRUE(undoEdit(session.state));
    EXPECT_EQ(session.state.document, before);
}

TEST_F(Exporting, TheDialogStartsBesideTheProjectAndFollowsTheFormat) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    state.projectPath = folder.file("room.limn");
    openExportDialog(state);
    EXPECT_EQ(state.exportDialog->path, folder.file("room-gltf.gltf"));
    ui.frames(state);
    ui.tap(key::kEscape);
    ui.frames(state);
    EXPECT_FALSE(state.exportDialog);
}

TEST_F(Exporting, TheDialogIsDrawnAtEverySizeAndInEveryState) {
    for (const float width : {120.f, 640.f, 1280.f}) {
        HeadlessUi ui(width, width * 0.6f);
        EditorState state = fullEditor();
        state.projectPath = folder.file(std::string(200, 'x') + ".limn");
        const Document before = state.document;
        openExportDialog(state);
        ui.frames(state);
        state.exporting.running = true;
        state.exporting.stage = "lightmap";
        ui.frames(state);
        state.exporting.running = false;
        state.exporting.error = std::string(300, 'e');
        ui.frames(state);
        EXPECT_EQ(state.document, before);
    }
}

} // namespace
} // namespace limn::export_test
