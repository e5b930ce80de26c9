// SPDX-License-Identifier: MIT
// Unsaved documents outlive the editor, however it ends, and its own files are never written.

#include "editor_ui/document/document_edit.h"
#include "editor_ui/jobs/recovery_folder.h"
#include "editor_ui/panels/action.h"
#include "tests/core/source_path.h"
#include "tests/core/temporary_folder.h"
#include "tests/editor_ui/headless.h"
#include "tests/editor_ui/small_session.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include <gtest/gtest.h>
#include <imgui.h>

namespace limn::recovery_test {
namespace {

namespace fs = std::filesystem;

struct RecoveryTest : testing::Test {
    TemporaryFolder folder;
    std::string project = folder.file("small.limn"), root = folder.file("state/limn/recovery");

    void SetUp() override {
        setenv("XDG_CONFIG_HOME", folder.path.c_str(), 1);
        ASSERT_TRUE(saveProject(project, smallDocument()));
    }

    SessionOptions options() const {
        return {.projectsFolder = sourcePath("projects"),
                .wake = [] {},
                .bakeOnOpen = false,
                .recoveryFolder = root};
    }
    std::unique_ptr<Session> opened(const std::string& what) const {
        auto session = std::make_unique<Session>(options());
        open(*session, what);
        return session;
    }
    static void open(Session& session, const std::string& what) {
        session.open(what);
        EXPECT_TRUE(runUntil(session, [&] { return session.idle(); }));
    }
    static void ask(Session& session, Request::Kind kind) {
        session.state.recovery.reset();
        session.state.requests.push_back({kind, {}});
        EXPECT_TRUE(runUntil(session, [&] { return session.idle(); }));
    }
    /// How many copies there are.
    std::size_t copies() const { return fs::exists(root) ? namesIn(root).size() : 0; }
    bool soonCopies(Session& session, std::size_t count) const {
        return runUntil(session, [&] { return copies() == count; });
    }
    void expectUntouchedProject() const {
        EXPECT_EQ(loadProject(project)->document, smallDocument());
    }
};

TEST_F(RecoveryTest, AnEditIsCopiedWithoutAFrameAndOfferedToTheNextEditor) {
    Document edited;
    {
        const auto session = opened(project);
        EXPECT_FALSE(session->state.recovery);
        EXPECT_EQ(copies(), 0U);
        addLight(session->state, Light{.name = "Unsaved"});
        session->update();
        edited = session->state.document;
    } // no quit: as after an exception
    ASSERT_EQ(copies(), 1U);
    expectUntouchedProject();

    const auto session = opened(project);
    ASSERT_TRUE(session->state.recovery);
    EXPECT_EQ(session->state.recovery->originalPath, project);
    EXPECT_NEAR(double(session->state.recovery->written), double(std::time(nullptr)), 60);
    EXPECT_NE(session->state.document, edited);
    ask(*session, Request::Kind::Recover);
    EXPECT_EQ(session->state.document, edited);
    EXPECT_EQ(session->state.projectPath, project);
    EXPECT_TRUE(hasUnsavedChanges(session->state));
    EXPECT_EQ(copies(), 1U) << "kept until it is saved";
    expectUntouchedProject();

    runAction(session->state, actionById("file.save"));
    ASSERT_TRUE(runUntil(*session, [&] { return !hasUnsavedChanges(session->state); }));
    EXPECT_EQ(loadProject(project)->document.objects, edited.objects);
    EXPECT_TRUE(soonCopies(*session, 0)) << "the file has it";
}

TEST_F(RecoveryTest, ARecoveredDocumentIsKeptWhenThatEditorEndsToo) {
    opened(project)->state.requests.clear();
    {
        const auto session = opened(project);
        addLight(session->state, Light{.name = "First"});
        session->update();
    }
    {
        const auto session = opened(project);
        ask(*session, Request::Kind::Recover);
        addLight(session->state, Light{.name = "Second"});
        session->update();
    }
    EXPECT_EQ(copies(), 1U);
    const auto session = opened(project);
    ask(*session, Request::Kind::Recover);
    EXPECT_NO_THROW(idNamed(session->state, "First"));
    EXPECT_NO_THROW(idNamed(session->state, "Second"));
}

TEST_F(RecoveryTest, ASampleThatWasNeverSavedIsRecoveredAsSuch) {
    {
        const auto session = opened("cornell");
        addLight(session->state, Light{.name = "Unsaved"});
        session->update();
    }
    const auto session = opened("cornell");
    ASSERT_TRUE(session->state.recovery);
    ask(*session, Request::Kind::Recover);
    EXPECT_NO_THROW(idNamed(session->state, "Unsaved"));
    EXPECT_EQ(session->state.projectPath, "");
    EXPECT_FALSE(session->state.assets->meshes.empty());
}

TEST_F(RecoveryTest, WhatIsUndoneDiscardedOrQuitOnPurposeLeavesNoCopy) {
    const auto session = opened(project);
    addLight(session->state, Light{});
    ASSERT_TRUE(soonCopies(*session, 1));
    undoEdit(session->state);
    EXPECT_TRUE(soonCopies(*session, 0));
    redoEdit(session->state);
    ASSERT_TRUE(soonCopies(*session, 1));
    session->state.requests.push_back({.kind = Request::Kind::Quit, .discardsChanges = true});
    session->update();
    EXPECT_TRUE(session->wantsQuit());
    EXPECT_TRUE(soonCopies(*session, 0));
    EXPECT_FALSE(opened(project)->state.recovery);
}

TEST_F(RecoveryTest, ADiscardedCopyIsGoneAndAPostponedOneIsOfferedAgain) {
    {
        const auto session = opened(project);
        addLight(session->state, Light{});
        session->update();
    }
    {
        const auto session = opened(project);
        ask(*session, Request::Kind::PostponeRecovery);
        EXPECT_EQ(copies(), 1U);
        open(*session, project);
        ASSERT_TRUE(session->state.recovery) << "of the document that was opened";
        ask(*session, Request::Kind::DiscardRecovery);
        EXPECT_EQ(copies(), 0U);
    }
    EXPECT_FALSE(opened(project)->state.recovery);
}

TEST_F(RecoveryTest, AnEditorThatRunsKeepsItsCopyFromOthers) {
    const auto first = opened(project);
    addLight(first->state, Light{.name = "Mine"});
    ASSERT_TRUE(soonCopies(*first, 1));
    const auto second = opened(project);
    EXPECT_FALSE(second->state.recovery);
    addLight(second->state, Light{.name = "Other"});
    ASSERT_TRUE(soonCopies(*second, 2));
    second->state.requests.push_back({.kind = Request::Kind::Quit, .discardsChanges = true});
    ASSERT_TRUE(soonCopies(*second, 1));
    const std::string mine = fs::path(root) / namesIn(root)[0] / "document.limn";
    EXPECT_NE(fileBytes(mine).find("Mine"), std::string::npos);
}

TEST_F(RecoveryTest, TwoEditorsAreNotOfferedTheSameCopy) {
    {
        const auto session = opened(project);
        addLight(session->state, Light{});
        session->update();
    }
    const auto first = opened(project), second = opened(project);
    EXPECT_TRUE(first->state.recovery);
    EXPECT_FALSE(second->state.recovery);
}

TEST_F(RecoveryTest, OnlyTheStartOffersTheCopyOfAnotherDocument) {
    {
        const auto session = opened(project);
        addLight(session->state, Light{});
        session->update();
    }
    const auto session = opened("signs");
    ASSERT_TRUE(session->state.recovery);
    EXPECT_EQ(session->state.recovery->originalPath, project);
    ask(*session, Request::Kind::PostponeRecovery);
    open(*session, "cornell");
    EXPECT_FALSE(session->state.recovery);
}

TEST_F(RecoveryTest, ADamagedCopyIsAnErrorThatKeepsItAndTheDocument) {
    {
        const auto session = opened(project);
        addLight(session->state, Light{});
        session->update();
    }
    ASSERT_EQ(copies(), 1U);
    writeFile(fs::path(root) / namesIn(root)[0] / "document.limn", "{\"version\": 1, \"obj");
    const auto session = opened(project);
    const Document before = session->state.document;
    ask(*session, Request::Kind::Recover);
    EXPECT_EQ(session->state.log.back().level, LogLine::Level::Error);
    EXPECT_EQ(session->state.document, before);
    EXPECT_EQ(copies(), 1U);
}

// The dialogs, drawn without a window.
struct Asking : RecoveryTest {
    std::unique_ptr<Session> session;
    std::optional<HeadlessUi> ui;

    void SetUp() override {
        RecoveryTest::SetUp();
        session = opened(project);
        addLight(session->state, Light{.name = "Unsaved"});
        ui.emplace();
    }
    void press(int key, std::uint8_t mods = kNoMods) {
        ui->tap(key, mods);
        frames();
    }
    void frames() {
        for (int i = 0; i < 4; ++i) {
            ui->frames(session->state);
            session->update();
        }
    }
};

TEST_F(Asking, QuittingSavesFirstIfToldSo) {
    press(key::of('Q'), kCtrl);
    ASSERT_TRUE(session->state.confirm);
    EXPECT_FALSE(session->wantsQuit());
    press(key::kEnter);
    ASSERT_TRUE(runUntil(*session, [&] { return session->wantsQuit(); }));
    EXPECT_EQ(loadProject(project)->document.objects, session->state.document.objects);
}

TEST_F(Asking, CancellingKeepsTheEditorOpenAndItsFileAsItWas) {
    press(key::of('Q'), kCtrl);
    press(key::kEscape);
    EXPECT_FALSE(session->state.confirm);
    EXPECT_FALSE(session->wantsQuit());
    EXPECT_TRUE(hasUnsavedChanges(session->state));
    expectUntouchedProject();
}

TEST_F(Asking, QuittingWhatHasNoFileAsksForOneAndThenQuits) {
    session->state.projectPath.clear();
    press(key::of('Q'), kCtrl);
    press(key::kEnter);
    ASSERT_TRUE(session->state.fileBrowser);
    press(key::kEscape);
    EXPECT_FALSE(session->wantsQuit()) << "no file was chosen";
    EXPECT_FALSE(session->state.afterSave);

    press(key::of('Q'), kCtrl);
    press(key::kEnter);
    ASSERT_TRUE(session->state.fileBrowser);
    session->state.fileBrowser.reset();
    const std::string chosen = folder.file("chosen.limn");
    session->state.requests.push_back({Request::Kind::Save, chosen});
    ASSERT_TRUE(runUntil(*session, [&] { return session->wantsQuit(); }));
    EXPECT_TRUE(loadProject(chosen));
}

TEST_F(Asking, ASaveThatFailsDoesNotQuit) {
    session->state.projectPath = folder.file("no folder/small.limn");
    press(key::of('Q'), kCtrl);
    press(key::kEnter);
    ASSERT_TRUE(runUntil(*session, [&] { return session->idle(); }));
    session->update();
    EXPECT_FALSE(session->wantsQuit());
    EXPECT_TRUE(hasUnsavedChanges(session->state));
    EXPECT_EQ(session->state.log.back().level, LogLine::Level::Error);
}

TEST_F(Asking, EnterRecovers) {
    const Document edited = session->state.document;
    session->update();
    session.reset();
    session = opened(project);
    ASSERT_TRUE(session->state.recovery);
    frames();
    press(key::kEnter);
    ASSERT_TRUE(runUntil(*session, [&] { return session->idle(); }));
    EXPECT_EQ(session->state.document, edited);
}

} // namespace
} // namespace limn::recovery_test
