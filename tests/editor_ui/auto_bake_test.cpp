// SPDX-License-Identifier: MIT
// Bakes that start by themselves, and what is said about them.

#include "editor_ui/document/document_edit.h"
#include "editor_ui/jobs/scene_changes.h"
#include "editor_ui/jobs/selection_bake.h"
#include "editor_ui/panels/action.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "tests/core/source_path.h"
#include "tests/core/temporary_folder.h"
#include "tests/editor_ui/headless.h"
#include "tests/editor_ui/small_session.h"

#include <array>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

namespace limn::auto_bake_test {
namespace {

struct AutoBake : testing::Test {
    TemporaryFolder folder;
    std::unique_ptr<Session> session;
    std::shared_ptr<const Precomputed> shown;
    int bakes = 0; ///< that became the one shown, since the document was opened

    void SetUp() override {
        setenv("XDG_CONFIG_HOME", folder.path.c_str(), 1);
        ASSERT_TRUE(saveProject(folder.file("small.limn"), smallDocument()));
        session = std::make_unique<Session>(SessionOptions{
            .projectsFolder = sourcePath("projects"), .wake = [] {}, .bakeOnOpen = true});
        session->open(folder.file("small.limn"));
        ASSERT_TRUE(isBaked());
        bakes = 0;
    }

    bool until(const std::function<bool()>& done) {
        return runUntil(*session, [&] {
            if (shown != session->baked().bake)
                ++bakes;
            shown = session->baked().bake;
            return done();
        });
    }
    bool isBaked() {
        return until([&] {
            return session->idle() && session->state.bake.freshness == BakeFreshness::UpToDate;
        });
    }
    bool isNeeded() {
        return until([&] { return session->state.bake.freshness == BakeFreshness::Needed; });
    }
    Node& block() const {
        return std::get<Node>(
            session->state.document.objects.at(idNamed(session->state, "Short block")));
    }
    /// Moves the block as a drag does: the history gets the edit when it is let go.
    void drag(double x) const {
        const ObjectId id = idNamed(session->state, "Short block");
        Object seen = session->state.document.objects.at(id);
        block().transform.translation.x += x;
        trackEdit(session->state, id, seen, "Move");
    }
    void makeBakesSlow() const {
        for (auto& [id, object] : session->state.document.objects)
            if (auto* settings = std::get_if<BakeSettings>(&object))
                settings->rays = 2048, settings->lightmapCaches = 6000; // seconds
    }
};

TEST_F(AutoBake, IsOnAndWaitsUntilADragHasEnded) {
    for (int step = 0; step < 5; ++step) {
        drag(0.02);
        ASSERT_TRUE(isNeeded());
        for (int i = 0; i < 20; ++i)
            session->update();
        ASSERT_FALSE(session->state.bake.running) << "of a place that nobody keeps";
    }
    commitGesture(session->state);
    ASSERT_TRUE(isBaked());
    EXPECT_EQ(bakes, 1);
}

TEST_F(AutoBake, ANewerEditTakesThePlaceOfTheRunningBake) {
    makeBakesSlow();
    ASSERT_TRUE(until([&] { return session->state.bake.stage == "trace"; }));
    for (auto& [id, object] : session->state.document.objects)
        if (auto* settings = std::get_if<BakeSettings>(&object))
            settings->rays = 32, settings->lightmapCaches = 300;
    block().transform.translation.x += 0.1;
    ASSERT_TRUE(isBaked());
    EXPECT_EQ(bakes, 1) << "the first was of no use any more";
    EXPECT_EQ(session->baked().scene->bake.rays, 32U);
    EXPECT_EQ(session->state.bake.error, "");
}

TEST_F(AutoBake, WhatTheUserCancelledIsNotStartedAgainBeforeTheNextEdit) {
    makeBakesSlow();
    ASSERT_TRUE(until([&] { return session->state.bake.stage == "trace"; }));
    runAction(session->state, actionById("bake.cancel"));
    ASSERT_TRUE(until([&] { return !session->state.bake.running && session->idle(); }));
    for (int i = 0; i < 50; ++i) {
        session->update();
        ASSERT_FALSE(session->state.bake.running);
    }
    EXPECT_EQ(session->state.bake.error, "cancelled");
    block().transform.translation.x += 0.1;
    EXPECT_TRUE(until([&] { return session->state.bake.running; }));
}

TEST_F(AutoBake, ABakeOfTheSelectionIsNotFollowedByAWholeOneBeforeTheNextEdit) {
    EditorState& state = session->state;
    EXPECT_FALSE(actionById("bake.selection").enabled(state)) << "nothing is selected";
    state.selection = {idNamed(state, "Short block")};
    runAction(state, actionById("bake.selection"));
    const auto before = session->baked().bake;
    ASSERT_TRUE(until([&] { return session->baked().bake != before && session->idle(); }));
    EXPECT_TRUE(state.bake.selection);
    EXPECT_LT(session->baked().bake->settings().lightmapCaches, before->settings().lightmapCaches);
    EXPECT_EQ(session->scene()->bake, before->settings()) << "the document keeps its settings";
    for (int i = 0; i < 50; ++i) {
        session->update();
        ASSERT_FALSE(state.bake.running);
    }
    EXPECT_EQ(state.bake.freshness, BakeFreshness::Needed);
    EXPECT_EQ(bakeReason(state.bake), "only a selection has all of its texels");
    block().transform.translation.x += 0.1;
    ASSERT_TRUE(isBaked());
    EXPECT_FALSE(state.bake.selection);
    EXPECT_EQ(session->baked().bake->settings(), before->settings());
}

TEST(SelectionScene, TheSelectionKeepsItsTexelsAndTheRestHasASixteenth) {
    const EditorState full = fullEditor();
    Scene scene = flatten(full.document, full.assets);
    scene.bake.lightmapCaches = 3200;
    const ObjectId left = idNamed(full, "Left");
    const Scene one = selectionScene(scene, std::array{left});
    std::size_t kept = 0;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const bool chosen = scene.instances[i].node == left;
        kept += chosen ? 1 : 0;
        EXPECT_EQ(one.instances[i].texelDensity,
                  scene.instances[i].texelDensity * (chosen ? 1 : kUnselectedDensity));
    }
    ASSERT_EQ(kept, 1U);
    ASSERT_EQ(scene.instances.size(), 2U) << "of the same mesh";
    const double left2 = worldArea(scene, scene.instances[0]),
                 right2 = worldArea(scene, scene.instances[1]);
    const double chosen = scene.instances[0].node == left ? left2 : right2;
    const double rest = left2 + right2 - chosen;
    EXPECT_NEAR(one.bake.lightmapCaches, 3200 * (chosen + rest / 16) / (chosen + rest), 1);
    std::vector<ObjectId> all;
    for (const Instance& instance : scene.instances)
        all.push_back(instance.node);
    EXPECT_EQ(selectionScene(scene, all).bake, scene.bake);
    scene.bake.lightmapCaches = 0;
    scene.bake.texelsPerMetre = 4;
    EXPECT_EQ(selectionScene(scene, std::array{left}).bake, scene.bake);
}

TEST_F(AutoBake, ItsBarNeverRunsBackwards) {
    for (auto& [id, object] : session->state.document.objects)
        if (auto* settings = std::get_if<BakeSettings>(&object))
            settings->rays = 1024, settings->lightmapCaches = 2000; // half a second
    float fraction = 0;
    bool ran = false;
    ASSERT_TRUE(until([&] {
        const BakeStatus& bake = session->state.bake;
        if (bake.running) {
            EXPECT_GE(bake.fraction, fraction) << bake.stage;
            fraction = bake.fraction;
            ran = true;
        }
        return ran && !bake.running;
    }));
    EXPECT_GT(fraction, 0);
}

TEST_F(AutoBake, SaysByNameWhyABakeIsNeeded) {
    session->state.autoBake = false;
    block().transform.translation.x += 0.1;
    ASSERT_TRUE(isNeeded());
    EXPECT_EQ(session->state.bake.changes, "Short block moved");
    for (auto& [id, object] : session->state.document.objects)
        if (auto* settings = std::get_if<BakeSettings>(&object))
            settings->rays = 64;
        else if (auto* relight = std::get_if<RelightSettings>(&object))
            relight->maxBounces = 3; // needs no bake
    ASSERT_TRUE(isNeeded());
    EXPECT_EQ(session->state.bake.changes, "Short block moved, Rays per cache changed");
    block().visible = false;
    ASSERT_TRUE(isNeeded());
    EXPECT_EQ(session->state.bake.changes, "Short block was hidden, Rays per cache changed");
    block() = {};
    for (auto& [id, object] : session->state.document.objects)
        if (auto* node = std::get_if<Node>(&object); node && node->name != "Floor")
            node->visible = false;
    ASSERT_TRUE(isNeeded());
    EXPECT_NE(session->state.bake.changes.find(", and "), std::string::npos)
        << session->state.bake.changes;
}

TEST(BakeInputChanges, NamesMaterialsAddedAndDeletedObjectsAndThoseThatBecameDynamic) {
    const EditorState full = fullEditor();
    const Scene before = flatten(full.document, full.assets);
    EXPECT_EQ(bakeInputChanges(before, before, full.document), "");
    const auto after = [&](const char* name, const auto& edit) {
        Document document = full.document;
        edit(document, document.objects.at(idNamed(full, name)));
        return bakeInputChanges(before, flatten(document, full.assets), document);
    };
    const ObjectId left = idNamed(full, "Left");
    EXPECT_EQ(after("Left", [](Document&, Object& o) { std::get<Node>(o).dynamic = true; }),
              "Left became dynamic");
    EXPECT_EQ(after("Left", [](Document&, Object& o) { std::get<Node>(o).texelDensity = 2; }),
              "Left has another texel density");
    EXPECT_EQ(after("Left", [&](Document& d, Object&) { d.objects.erase(left); }),
              "An object was deleted");
    EXPECT_EQ(after("Left",
                    [](Document& d, Object& o) {
                        Node copy = std::get<Node>(o);
                        copy.name = "Third";
                        addObject(d, copy);
                    }),
              "Third was added or shown");
    EXPECT_EQ(after("Stone",
                    [](Document&, Object& o) {
                        std::get<Material>(o).emission = {1, 1, 1};
                    }),
              "Stone emits light now");
    EXPECT_EQ(after("Glow", [](Document&, Object& o) { std::get<Material>(o).emission *= 2; }), "");
    EXPECT_EQ(after("Lamp", [](Document&, Object& o) { std::get<Light>(o).strength = 7; }), "");
    EXPECT_EQ(
        after("Group", [](Document&, Object& o) { std::get<Node>(o).transform.translation.x = 9; }),
        "Left moved, Right moved");
}

} // namespace
} // namespace limn::auto_bake_test
