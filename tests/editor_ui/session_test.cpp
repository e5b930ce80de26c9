// SPDX-License-Identifier: MIT
// The document with its jobs beside it: opening, baking, relighting, saving. No window, no GPU.

#include "editor_ui/document/document_edit.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/overlay_panel.h"
#include "engine/files/image_file.h"
#include "engine/files/project_file.h"
#include "engine/techniques/technique_table.h"
#include "tests/core/source_path.h"
#include "tests/editor_ui/headless.h"
#include "tests/editor_ui/session_fixture.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <imgui_internal.h>
#include <unistd.h>

namespace limn::session_test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// A count of the last bake.
double counted(const Session& session, const char* id) {
    return counterOf(session.state.bake.last.counts, id);
}

TEST_F(SessionTest, AnOpenedSceneIsBakedAndLitUntilItConverges) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    EXPECT_EQ(session.state.bake.freshness, BakeFreshness::UpToDate);
    EXPECT_GT(counted(session, "surfels"), 0);
    ASSERT_TRUE(session.layout());
    EXPECT_EQ(session.layout()->instances.size(), session.scene()->instances.size());
    ASSERT_TRUE(session.field());
    EXPECT_FALSE(hasUnsavedChanges(session.state));
}

TEST_F(SessionTest, TimeThatGoesOnPlaysAnimatedTexturesAndOnlyThoseAndChangesNoDocument) {
    Session session(options());
    session.open("signs");
    ASSERT_TRUE(runUntil(session, [&] { return session.scene()->materials.size() > 7; }));
    const auto still = session.scene();
    session.state.seconds = 0.01; // all textures still show their first frame
    session.update();
    EXPECT_EQ(session.scene(), still);
    session.state.seconds = 0.5;
    session.update();
    ASSERT_NE(session.scene(), still);
    for (std::size_t m = 0; m < still->materials.size(); ++m) {
        const bool animated = isAnimated(still->materials[m]);
        EXPECT_EQ(session.scene()->materials[m] != still->materials[m], animated) << m;
    }
    EXPECT_FALSE(hasUnsavedChanges(session.state));
    const auto play = std::ranges::find(actions(), std::string("view.play"), &Action::id);
    ASSERT_TRUE(play != actions().end() && play->enabled(session.state));
    runAction(session.state, *play);
    EXPECT_TRUE(session.state.playing);
}

TEST_F(SessionTest, AnOverlayOfLightGetsWhatTheFieldWasMadeOf) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    EXPECT_FALSE(session.lit());
    const auto kinds = overlayKinds();
    const auto ofLight = std::ranges::find(kinds, true, &OverlayKind::showsLight);
    ASSERT_NE(ofLight, kinds.end());
    session.state.overlay.options.kind = *ofLight;
    ASSERT_TRUE(runUntil(session, [&] { return session.lit() != nullptr; }));
    const BakedScene& baked = session.baked();
    const OverlayRequest request{.kind = *ofLight};
    const OverlayData lit = baked.bake->overlay(request, *baked.scene, session.lit().get());
    EXPECT_FALSE(lit.marks.empty());
    EXPECT_TRUE(baked.bake->overlay(request, *baked.scene, nullptr).marks.empty());
    session.state.overlay.options.kind = nullptr;
    session.update();
    ASSERT_TRUE(runUntil(session, [&] { return !session.lit(); }));
}

TEST_F(SessionTest, AnOverlayOfATechniqueWithoutABakeIsMadeOfItsNewestLight) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    OverlayState& overlay = session.state.overlay;
    EXPECT_EQ(overlay.source, session.baked().bake);
    const auto kinds = overlayKinds();
    const auto lobes = std::ranges::find(kinds, std::string_view("lpv-lobes"), &OverlayKind::name);
    ASSERT_NE(lobes, kinds.end());
    overlay.options.kind = *lobes;
    session.update();
    EXPECT_FALSE(overlay.source) << "another technique is chosen";
    chooseTechnique(session.state.document, "lpv");
    ASSERT_TRUE(runUntil(session, [&] { return overlay.source != nullptr; }));
    EXPECT_STREQ(overlay.source->technique().name, "lpv");
    pickNumber(overlay, 7);
    EXPECT_FALSE(overlay.picked.empty());
    const auto before = overlay.source;
    lamp(session).strength *= 2;
    ASSERT_TRUE(runUntil(session, [&] { return overlay.source && overlay.source != before; }));
    EXPECT_EQ(overlay.options.pick, 7U);
    chooseTechnique(session.state.document, "ambient");
    ASSERT_TRUE(runUntil(session, [&] { return !overlay.source; }));
    overlay.options.kind = nullptr;
    session.update();
    EXPECT_EQ(overlay.source, session.baked().bake);
}

TEST_F(SessionTest, AnEditedLightChangesTheFieldWithoutABakeAndUndoRestoresIt) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    const auto before = session.field();
    const auto calls = session.state.relight.calls;
    const Light original = lamp(session);
    Edit edit{"Move", {}};
    for (const auto& [id, object] : session.state.document.objects)
        if (objectName(object) == "Lamp") {
            Light moved = original;
            moved.position.x += 0.4f;
            edit.changes.push_back({id, object, moved});
        }
    apply(session.state.history, session.state.document, edit);
    session.update();
    ASSERT_TRUE(runUntil(session, [&] {
        return session.state.relight.calls > calls && session.state.relight.converged;
    }));
    EXPECT_NE(session.field()->lightmap, before->lightmap);
    EXPECT_EQ(session.state.bake.secondsSinceLightEdit, 0);
    EXPECT_EQ(session.state.bake.freshness, BakeFreshness::UpToDate);

    const auto moved = session.state.relight.calls;
    ASSERT_TRUE(undoEdit(session.state));
    session.update();
    ASSERT_TRUE(runUntil(session, [&] {
        return session.state.relight.calls > moved && session.state.relight.converged;
    }));
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < before->lightmap.size(); ++i) {
        difference += std::abs(double(session.field()->lightmap[i].x - before->lightmap[i].x));
        sum += std::abs(double(before->lightmap[i].x));
    }
    EXPECT_LT(difference, 1e-3 * sum); // both converged to one part in ten thousand
}

TEST_F(SessionTest, RelightingRestsWhileTheViewportDoesItAndGoesOnAfterwards) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    RelightPlace& place = session.state.relightPlace;
    place.wanted = RelightOn::Gpu;
    session.update();
    EXPECT_TRUE(session.field()) << "there is no GPU";
    place.gpuCan = true;
    ASSERT_TRUE(runUntil(session, [&] { return !session.field(); }));
    EXPECT_TRUE(session.viewportRelights());
    session.state.relight = {}; // the viewport's from now on
    lamp(session).strength = 3;
    session.update();
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    EXPECT_EQ(session.state.relight.calls, 0U);
    EXPECT_FALSE(session.field());
    EXPECT_EQ(session.state.bake.freshness, BakeFreshness::UpToDate) << "rays and hash go on";

    place.wanted = RelightOn::Auto;
    place.times = RelightTimes{.cpuMs = 2, .gpuMs = 1};
    session.update();
    EXPECT_TRUE(session.viewportRelights()) << "the faster one";
    place.times = RelightTimes{.cpuMs = 1, .gpuMs = 2};
    ASSERT_TRUE(runUntilIdle(session));
    EXPECT_GT(session.state.relight.calls, 0U);
    EXPECT_TRUE(session.field());
}

TEST_F(SessionTest, AnotherTechniqueLightsAtOnceAndUndoBringsTheBakedLightBack) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    EXPECT_FALSE(hasUnsavedChanges(session.state)) << "that it is listed is no edit";
    const auto baked = session.field();
    ASSERT_GT(baked->lightmapWidth, 0U);
    Edit edit{"Technique", {}};
    for (const auto& [id, object] : session.state.document.objects)
        if (std::holds_alternative<TechniqueChoice>(object))
            edit.changes.push_back(
                {id, object,
                 TechniqueChoice{"ambient", {{"ambient.constant", 1}, {"ambient.radiance", 2}}}});
    ASSERT_EQ(edit.changes.size(), 1U);
    apply(session.state.history, session.state.document, edit);
    const double before = session.bakeSeconds();
    session.update();
    ASSERT_TRUE(runUntil(session, [&] {
        return session.idle() && session.field() && session.field()->lightmapWidth == 0;
    }));
    EXPECT_EQ(session.state.bake.freshness, BakeFreshness::NotUsed);
    EXPECT_EQ(session.bakeSeconds(), before);
    EXPECT_TRUE(session.layout()->instances[0].uv.empty()) << "all are lit from the grid";
    EXPECT_NEAR(session.field()->grid[0].x, 2 * 2 * std::sqrt(3.14159265), 1e-4);
    session.state.relightPlace.gpuCan = true;
    session.state.relightPlace.wanted = RelightOn::Gpu;
    EXPECT_TRUE(session.viewportRelights()) << "no bake is needed";
    session.state.relightPlace.wanted = RelightOn::Cpu;

    ASSERT_TRUE(undoEdit(session.state));
    session.update();
    ASSERT_TRUE(runUntil(session, [&] {
        return session.idle() && session.field() && session.field()->lightmapWidth > 0;
    }));
    EXPECT_EQ(session.state.bake.freshness, BakeFreshness::UpToDate);
    EXPECT_EQ(session.field()->lightmap, baked->lightmap);
    EXPECT_EQ(session.bakeSeconds(), before) << "the bake was kept";
}

TEST_F(SessionTest, AMovedObjectMakesANewBakeNeededAndTheOldLightStays) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    for (auto& [id, object] : session.state.document.objects)
        if (auto* node = std::get_if<Node>(&object); node && node->name == "Short block")
            node->transform.translation.x += 0.1f;
    ASSERT_TRUE(
        runUntil(session, [&] { return session.state.bake.freshness == BakeFreshness::Needed; }));
    EXPECT_TRUE(session.field());
    const auto calls = session.state.relight.calls;
    lamp(session).strength = 3; // light still follows, over the old geometry
    ASSERT_TRUE(runUntil(session, [&] { return session.state.relight.calls > calls; }));
    runAction(session.state, actionById("bake.start"));
    ASSERT_TRUE(
        runUntil(session, [&] { return session.state.bake.freshness == BakeFreshness::UpToDate; }));
}

// How much a surface emits is light; that it emits at all guides where a bake puts its surfels.
TEST_F(SessionTest, ASurfaceThatStartsToEmitMakesANewBakeNeeded) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    const auto darkMaterial = [&]() -> Material& {
        for (auto& [id, object] : session.state.document.objects)
            if (auto* material = std::get_if<Material>(&object);
                material && material->emission == glm::vec3(0))
                return *material;
        throw std::runtime_error("no material that emits nothing");
    };
    Material& material = darkMaterial();
    material.emission = glm::vec3(1);
    ASSERT_TRUE(
        runUntil(session, [&] { return session.state.bake.freshness == BakeFreshness::Needed; }));
    runAction(session.state, actionById("bake.start"));
    ASSERT_TRUE(runUntilIdle(session));
    ASSERT_EQ(session.state.bake.freshness, BakeFreshness::UpToDate);
    material.emission = glm::vec3(2);
    session.update();
    EXPECT_EQ(session.state.bake.freshness, BakeFreshness::UpToDate);
}

TEST_F(SessionTest, AMovedDynamicObjectNeedsNoBakeAndMovesItsShadow) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    const auto shortBlock = [&]() -> Node& {
        for (auto& [id, object] : session.state.document.objects)
            if (auto* node = std::get_if<Node>(&object); node && node->name == "Short block")
                return *node;
        throw std::runtime_error("no block");
    };
    session.state.autoBake = true;
    shortBlock().dynamic = true;
    ASSERT_TRUE(
        runUntil(session, [&] { return session.state.bake.freshness == BakeFreshness::Needed; }));
    ASSERT_TRUE(runUntilIdle(session));
    ASSERT_EQ(session.state.bake.freshness, BakeFreshness::UpToDate);
    const double seconds = session.bakeSeconds();
    const auto before = session.field();
    shortBlock().transform.translation = {0.4f, 0.8f, 0};
    ASSERT_TRUE(runUntil(session, [&] { return session.field() != before && session.idle(); }));
    EXPECT_EQ(session.state.bake.freshness, BakeFreshness::UpToDate);
    EXPECT_EQ(session.bakeSeconds(), seconds);
    EXPECT_NE(session.field()->lightmap, before->lightmap);
}

TEST_F(SessionTest, ABakeUsesTheSettingsOfTheDocument) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    for (auto& [id, object] : session.state.document.objects)
        if (auto* settings = std::get_if<BakeSettings>(&object))
            settings->surfels = 500;
    ASSERT_TRUE(
        runUntil(session, [&] { return session.state.bake.freshness == BakeFreshness::Needed; }));
    runAction(session.state, actionById("bake.start"));
    ASSERT_TRUE(
        runUntil(session, [&] { return session.state.bake.freshness == BakeFreshness::UpToDate; }));
    EXPECT_NEAR(counted(session, "surfels"), 500, 50);
}

TEST_F(SessionTest, HidingAnObjectKeepsTheLightmapsOfTheOthers) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    for (auto& [id, object] : session.state.document.objects)
        if (auto* node = std::get_if<Node>(&object); node && node->name == "Floor")
            node->visible = false;
    session.update();
    ASSERT_EQ(session.layout()->instances.size(), session.scene()->instances.size());
    for (const InstanceLightmap& instance : session.layout()->instances)
        EXPECT_FALSE(instance.uv.empty());
}

TEST_F(SessionTest, ACancelledBakeStopsAtOnceAndLeavesTheLastOne) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    for (auto& [id, object] : session.state.document.objects)
        if (auto* settings = std::get_if<BakeSettings>(&object))
            settings->rays = 2048, settings->lightmapCaches = 6000; // seconds
    runAction(session.state, actionById("bake.start"));
    ASSERT_TRUE(runUntil(session, [&] {
        return session.state.bake.running && session.state.bake.stage == "trace";
    }));
    const auto field = session.field();
    runAction(session.state, actionById("bake.cancel"));
    ASSERT_TRUE(runUntil(session, [&] { return !session.state.bake.running; }));
    session.update();
    EXPECT_EQ(session.state.bake.error, "cancelled");
    EXPECT_EQ(session.field(), field);
    EXPECT_EQ(session.state.bake.freshness, BakeFreshness::Needed);
}

TEST_F(SessionTest, WhatIsSavedOpensAgainWithItsBake) {
    Document saved;
    {
        Session session(options());
        session.open(project);
        ASSERT_TRUE(runUntilIdle(session));
        addLight(session.state, Light{.name = "Second"});
        EXPECT_TRUE(hasUnsavedChanges(session.state));
        runAction(session.state, actionById("file.save"));
        ASSERT_TRUE(runUntil(session, [&] { return !hasUnsavedChanges(session.state); }));
        saved = session.state.document;
    }
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    EXPECT_EQ(session.state.document.objects, saved.objects);
    EXPECT_EQ(session.bakeSeconds(), 0); // the bake lay beside it
    EXPECT_EQ(session.state.recent.at(0), project);
}

// Whoever looks at an idle session sees what its jobs gave.
TEST_F(SessionTest, IsNotIdleBeforeAFinishedJobHasBeenTaken) {
    std::atomic<int> wakes = 0;
    SessionOptions woken = options();
    woken.wake = [&] { ++wakes; };
    Session session(woken);
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    lamp(session).strength = 3;
    ASSERT_TRUE(runUntilIdle(session));
    wakes = 0;
    runAction(session.state, actionById("file.save"));
    session.update(); // starts it
    while (wakes == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_FALSE(session.idle() && hasUnsavedChanges(session.state));
    ASSERT_TRUE(runUntilIdle(session));
    EXPECT_FALSE(hasUnsavedChanges(session.state));
}

TEST_F(SessionTest, LeavingAChangedDocumentAsksFirst) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    addLight(session.state, Light{});
    runAction(session.state, actionById("file.quit"));
    session.update();
    EXPECT_FALSE(session.wantsQuit());
    ASSERT_TRUE(session.state.confirm);
    EXPECT_EQ(session.state.confirm->kind, Request::Kind::Quit);
}

TEST_F(SessionTest, ADroppedPanoramaBecomesTheSkyEvenOfAChangedDocumentAndIsUndone) {
    SessionOptions unbaked = options();
    unbaked.bakeOnOpen = false;
    Session session(unbaked);
    session.open(project);
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    addLight(session.state, Light{});
    const Document before = session.state.document;
    const std::string path = (folder / "Sky.EXR").string();
    ASSERT_TRUE(writeExr(path, {4, 2, std::vector<glm::vec3>(8, glm::vec3(3))}));
    session.state.requests.push_back({Request::Kind::Open, path});
    ASSERT_TRUE(runUntil(session, [&] { return session.scene()->sky.showsImage(); }));
    EXPECT_FALSE(session.state.confirm) << "nothing is left";
    EXPECT_FALSE(session.state.notice);
    ASSERT_TRUE(undoEdit(session.state));
    EXPECT_EQ(session.state.document, before);
}

TEST_F(SessionTest, TheLogKeepsItsNewestLines) {
    SessionOptions unbaked = options();
    unbaked.bakeOnOpen = false;
    Session session(unbaked);
    session.state.log.assign(kMaxLogLines, {LogLine::Level::Info, "old"});
    session.state.requests.push_back({Request::Kind::Open, (folder / "none.gltf").string()});
    ASSERT_TRUE(runUntil(session, [&] { return session.state.notice.has_value(); }));
    EXPECT_EQ(session.state.log.size(), kMaxLogLines);
    EXPECT_EQ(session.state.log.back().level, LogLine::Level::Error);
}

TEST_F(SessionTest, WhatCannotBeOpenedIsSaidWithFileAndReasonUntilItIsDismissed) {
    SessionOptions unbaked = options();
    unbaked.bakeOnOpen = false;
    Session session(unbaked);
    const auto noticeOf = [&](const std::string& name, const std::string& bytes) {
        const std::string path = (folder / name).string();
        std::ofstream(path, std::ios::binary) << bytes;
        session.state.notice.reset();
        session.state.requests.push_back({Request::Kind::Open, path});
        EXPECT_TRUE(runUntil(session, [&] { return session.state.notice.has_value(); })) << name;
        EXPECT_NE(session.state.notice->text.find(path), std::string::npos) << name;
        EXPECT_EQ(session.state.log.back().level, LogLine::Level::Error) << name;
        return session.state.notice->text;
    };
    const std::string brackets(1000, '[');
    EXPECT_NE(noticeOf("photo.gltf", brackets).find("neither glTF nor GLB"), std::string::npos);
    EXPECT_NE(noticeOf("photo.png", "\x89PNG" + brackets).find("neither glTF"), std::string::npos);
    EXPECT_NE(noticeOf("sky.hdr", brackets).find("HDR"), std::string::npos);
    EXPECT_NE(noticeOf("old.limn", "{").find("JSON"), std::string::npos);

    HeadlessUi ui;
    ui.frames(session.state);
    ui.frames(session.state);
    ImGuiWindow* box = ImGui::FindWindowByName("notice");
    ASSERT_TRUE(box && box->Active);
    ui.mouse(box->Rect().Min.x + 30, box->Rect().Max.y - 16); // the button at its foot
    ui.frames(session.state);
    ui.button(true);
    ui.button(false);
    ui.frames(session.state);
    ui.frames(session.state);
    EXPECT_FALSE(session.state.notice);
    EXPECT_FALSE(box->Active);
}

TEST_F(SessionTest, AFileThatCannotBeOpenedIsAnErrorInTheLogAndTheDocumentStays) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    const Document before = session.state.document;
    session.open((folder / "missing.gltf").string());
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    ASSERT_FALSE(session.state.log.empty());
    EXPECT_EQ(session.state.log.back().level, LogLine::Level::Error);
    EXPECT_EQ(session.state.document, before);
}

TEST_F(SessionTest, ASampleIsSavedInTheUsersDocumentsHoweverItWasOpened) {
    const fs::path documents = folder / "Documents";
    fs::create_directory(documents);
    setenv("HOME", folder.c_str(), 1);
    SessionOptions unbaked = options();
    unbaked.bakeOnOpen = false;
    Session session(unbaked);
    const std::string shipped = unbaked.projectsFolder + "/cornell/cornell";
    for (const std::string& what : {std::string("cornell"), shipped + ".gltf", shipped + ".limn",
                                    unbaked.projectsFolder + "/../projects/cornell/cornell.limn"}) {
        session.open(what);
        ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
        ASSERT_FALSE(session.state.assets->meshes.empty()) << what;
        runAction(session.state, actionById("file.save"));
        ASSERT_TRUE(session.state.fileBrowser) << what << " would be replaced";
        EXPECT_EQ(session.state.fileBrowser->folder, documents) << what;
        EXPECT_EQ(session.state.fileBrowser->name, "cornell.limn");
        session.state.fileBrowser.reset();
    }
    session.open(project); // of a sample's scene, but the user's own
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    runAction(session.state, actionById("file.save_as"));
    EXPECT_EQ(session.state.fileBrowser->folder, folder);
}

TEST_F(SessionTest, AFirstLookOfFewRaysComesBeforeTheFullBake) {
    Document document = smallDocument();
    for (auto& [id, object] : document.objects)
        if (auto* settings = std::get_if<BakeSettings>(&object))
            settings->rays = 1024, settings->lightmapCaches = 2000;
    ASSERT_TRUE(saveProject(project, document));
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntil(session, [&] { return session.state.bake.preview && session.field(); }));
    EXPECT_TRUE(session.state.bake.running);
    const double first = counted(session, "rays");
    EXPECT_NE(session.state.bake.freshness, BakeFreshness::UpToDate);
    lamp(session).strength = 3; // light follows meanwhile
    const auto calls = session.state.relight.calls;
    ASSERT_TRUE(runUntil(session, [&] { return session.state.relight.calls > calls; }));
    ASSERT_TRUE(runUntilIdle(session));
    EXPECT_FALSE(session.state.bake.preview);
    EXPECT_EQ(session.state.bake.freshness, BakeFreshness::UpToDate);
    EXPECT_GT(counted(session, "rays"), 1024U * 1500);
    // 64 rays of each cache instead of 1024; those that tell sides of walls are the same for both.
    EXPECT_GT(first, 0U);
    EXPECT_GT(counted(session, "rays"), 4 * first);
}

TEST_F(SessionTest, AnotherNumberOfLinksTracesNoRay) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    EXPECT_GT(counted(session, "rays"), 0);
    for (auto& [id, object] : session.state.document.objects)
        if (auto* settings = std::get_if<BakeSettings>(&object))
            settings->links = 24;
    ASSERT_TRUE(
        runUntil(session, [&] { return session.state.bake.freshness == BakeFreshness::Needed; }));
    runAction(session.state, actionById("bake.start"));
    ASSERT_TRUE(
        runUntil(session, [&] { return session.state.bake.freshness == BakeFreshness::UpToDate; }));
    EXPECT_EQ(counted(session, "rays"), 0);
    ASSERT_FALSE(session.state.bake.last.notes.empty());
}

TEST(BakeEstimate, FollowsTheStagesPaceAndWhatLaterOnesTook) {
    const StageSeconds expected = {{"charts", 1}, {"trace", 10}, {"cut", 2}};
    EXPECT_LT(secondsLeft({}, "charts", 0.5, 1), 0);
    EXPECT_NEAR(secondsLeft(expected, "charts", 0, 0.1), 12.9, 1e-9);
    EXPECT_NEAR(secondsLeft(expected, "trace", 0.5, 3), 3 + 2, 1e-9); // faster than expected
    EXPECT_NEAR(secondsLeft(expected, "cut", 1, 2), 0, 1e-9);
    EXPECT_NEAR(secondsLeft(expected, "cut", 0, 8), 2, 1e-9) << "longer than expected";
    EXPECT_NEAR(secondsLeft(expected, "a part of the cut", 0, 8), 2, 1e-9);
    EXPECT_NEAR(secondsLeft(expected, "a part of the cut", 0.5, 0.5), 1.5, 1e-9);
}

} // namespace
} // namespace limn::session_test
