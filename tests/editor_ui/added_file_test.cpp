// SPDX-License-Identifier: MIT
// What is added to an open document from files and shapes. No window, no GPU.
#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/selection.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/file_browser.h"
#include "editor_ui/view/picking.h"
#include "editor_ui/view/shape_placement.h"
#include "engine/files/image_file.h"
#include "tests/core/temporary_folder.h"
#include "tests/editor_ui/cornell_view.h"
#include "tests/editor_ui/small_session.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::added_file_test {
namespace {

struct AddedFile : testing::Test {
    TemporaryFolder folder;
    std::string project = folder.file("small.limn");
    Session session{{sourcePath("projects"), [] {}, false}};
    EditorState& state = session.state;
    ObjectsById first;
    std::size_t meshes = 0;

    void SetUp() override {
        setenv("XDG_CONFIG_HOME", folder.path.c_str(), 1);
        ASSERT_TRUE(saveProject(project, smallDocument()));
        open(project);
        state.autoBake = false;
        first = state.document.objects;
        meshes = state.assets->meshes.size();
    }
    void open(const std::string& path) {
        session.open(path);
        ASSERT_TRUE(runUntil(session, [&] { return state.loading.empty(); }));
    }
    void add(const std::string& path, ObjectId material = 0) {
        Request request{Request::Kind::AddFile, path};
        request.object = material;
        request.place.translation = {0.25, 0.5, 0};
        request.place.scale = glm::vec3(0.1f);
        state.requests.push_back(request);
        session.update();
        ASSERT_TRUE(runUntil(session, [&] { return state.loading.empty(); }));
        session.update(); // the scene follows the document
    }
    std::size_t instancesOf(const std::string& mesh) const {
        return std::size_t(
            std::ranges::count_if(session.scene()->instances, [&](const Instance& i) {
                return session.scene()->meshOf(i).name == mesh;
            }));
    }
    const Material& anyMaterial(ObjectId& id) const {
        for (const auto& [key, object] : state.document.objects)
            if (const auto* material = std::get_if<Material>(&object)) {
                id = key;
                return *material;
            }
        throw std::runtime_error("no material");
    }
};

TEST_F(AddedFile, AShapeIsAnObjectWithAMaterialOfItsOwn) {
    add("shape:box");
    ASSERT_EQ(instancesOf("Box"), 1u);
    const Instance& box = session.scene()->instances.back();
    EXPECT_EQ(glm::vec3(box.toWorld[3]), glm::vec3(0.25f, 0.5f, 0));
    EXPECT_EQ(session.scene()->materialOf(box).name, "Box material");
    EXPECT_EQ(state.selection, std::vector{box.node});
    EXPECT_EQ(state.history.edits.size(), 1u);
    EXPECT_EQ(state.meshBounds.size(), state.assets->meshes.size());

    undoEdit(state);
    EXPECT_TRUE(state.document.objects == first);
    session.update();
    EXPECT_EQ(instancesOf("Box"), 0u);
    redoEdit(state);
    session.update();
    EXPECT_EQ(instancesOf("Box"), 1u);
}

TEST_F(AddedFile, TheSecondShapeOfAKindTakesTheMeshOfTheFirst) {
    add("shape:sphere");
    add("shape:sphere");
    EXPECT_EQ(instancesOf("Sphere"), 2u);
    EXPECT_EQ(state.assets->meshes.size(), meshes + 1);
    EXPECT_EQ(state.document.files.size(), 1u);
}

TEST_F(AddedFile, WhatWasAddedIsThereWhenTheProjectIsOpenedAgain) {
    add("shape:box");
    add(sourcePath("projects/signs/signs.gltf"));
    const ObjectsById before = state.document.objects;
    const std::size_t instances = session.scene()->instances.size();
    state.requests.push_back({Request::Kind::Save, project});
    ASSERT_TRUE(runUntil(session, [&] { return !hasUnsavedChanges(state) && session.idle(); }));
    open(project);
    EXPECT_TRUE(state.document.objects == before);
    EXPECT_EQ(instancesOf("Box"), 1u);
    EXPECT_EQ(session.scene()->instances.size(), instances);
}

TEST_F(AddedFile, ASceneComesAsAGroupWithItsMaterialsTexturesAndLights) {
    const std::string path = sourcePath("projects/signs/signs.gltf");
    const ImportedScene signs = *importGltf(path);
    const Scene alone = flatten(signs.document, signs.assets);
    const std::size_t instances = session.scene()->instances.size(),
                      lights = session.scene()->lights.size();
    add(path);
    const Scene& scene = *session.scene();
    ASSERT_EQ(scene.instances.size(), instances + alone.instances.size());
    EXPECT_EQ(scene.lights.size(), lights + alone.lights.size());
    for (std::size_t i = 0; i < alone.instances.size(); ++i) {
        const Instance &was = alone.instances[i], &is = scene.instances[instances + i];
        EXPECT_EQ(alone.meshOf(was), scene.meshOf(is));
        EXPECT_EQ(was.toWorld, is.toWorld);
        const Material &then = alone.materialOf(was), &now = scene.materialOf(is);
        EXPECT_EQ(then.name, now.name);
        if (then.emissiveTexture.image >= 0) {
            EXPECT_EQ(alone.assets->images[std::size_t(then.emissiveTexture.image)],
                      scene.assets->images[std::size_t(now.emissiveTexture.image)]);
        }
    }
    const auto* group = std::get_if<Node>(&state.document.objects.at(activeId(state)));
    ASSERT_TRUE(group);
    EXPECT_EQ(group->name, "signs");
    EXPECT_EQ(state.history.edits.size(), 1u);
    undoEdit(state);
    EXPECT_TRUE(state.document.objects == first);
}

TEST_F(AddedFile, AFileThatCannotBeReadIsNamedWithTheReasonAndChangesNothing) {
    for (const std::string name : {"absent.glb", "broken.gltf", "text.png"}) {
        const std::string path = folder.file(name);
        if (name != "absent.glb")
            writeFile(path, "no such format");
        ObjectId material = 0;
        anyMaterial(material);
        add(path, name == "text.png" ? material : 0);
        ASSERT_TRUE(state.notice) << name;
        EXPECT_EQ(state.notice->title, "Not added");
        EXPECT_NE(state.notice->text.find(name), std::string::npos) << state.notice->text;
        EXPECT_GT(state.notice->text.size(), path.size() + 5) << "has no reason";
        EXPECT_TRUE(state.document.objects == first);
        EXPECT_TRUE(state.history.edits.empty());
        state.notice.reset();
    }
}

TEST_F(AddedFile, AnImageBecomesTheTextureOfAMaterial) {
    const std::string path = folder.file("red.png");
    ASSERT_TRUE(writePng(path, {"", 1, 1, {255, 0, 0, 255}}));
    ObjectId id = 0;
    anyMaterial(id);
    add(path, id);
    const Material& material = std::get<Material>(state.document.objects.at(id));
    EXPECT_EQ(sampleTexture(*state.assets, material.baseColorTexture, {0, 0}, true),
              glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(state.history.edits.size(), 1u);
    undoEdit(state);
    EXPECT_TRUE(state.document.objects == first);
}

TEST_F(AddedFile, ABakeFollowsWhatWasAdded) {
    add("shape:box");
    state.requests.push_back({Request::Kind::Bake});
    ASSERT_TRUE(runUntil(session, [&] {
        return state.bake.freshness == BakeFreshness::UpToDate && session.idle();
    })) << state.bake.error;
    ASSERT_TRUE(session.layout());
    EXPECT_EQ(session.layout()->instances.size(), session.scene()->instances.size());
    // A new mesh is no part of the bake; the picture still has a layout that fits it.
    add("shape:cylinder");
    ASSERT_TRUE(session.layout());
    EXPECT_EQ(session.layout()->instances.size(), session.scene()->instances.size());
    EXPECT_EQ(session.layout()->meshes.size(), state.assets->meshes.size());
}

TEST(ShapePlacement, AShapeStandsOnTheSurfaceThatIsClicked) {
    const CornellView v;
    // The floor, and the back wall.
    for (const glm::vec2 pixel : {v.at(0.5f, 0.72f), v.at(0.5f, 0.35f)}) {
        const Hit hit = hitUnder(v.state, pixel);
        ASSERT_TRUE(hit);
        const Transform place = shapeAtPixel(v.state, pixel);
        EXPECT_LT(glm::distance(glm::vec3(place.translation), hit.position), 1e-5f);
        const glm::vec3 up = place.rotation * glm::vec3(0, 1, 0);
        EXPECT_GT(std::abs(glm::dot(up, hit.geometricNormal)), 0.9999f);
        EXPECT_LT(glm::dot(up, hit.position - v.state.view.camera.eye), 0) << "faces the viewer";
        const float distance = glm::distance(hit.position, v.state.view.camera.eye);
        EXPECT_NEAR(place.scale.x, distance / 6, 0.05f * distance / 6);
    }
}

TEST(ShapePlacement, AClickAsksForTheShapeAndEscapeTakesItBack) {
    CornellView v;
    runAction(v.state, actionById("add.sphere"));
    EXPECT_TRUE(actionById("add.sphere").checked(v.state));
    EXPECT_FALSE(actionById("add.box").checked(v.state));
    const glm::vec2 pixel = glm::floor(v.at(0.5f, 0.72f)); // as mice have it
    v.ui.mouse(pixel.x, pixel.y);
    v.ui.frames(v.state);
    v.ui.button(true);
    v.ui.frames(v.state);
    v.ui.button(false);
    v.ui.frames(v.state);
    EXPECT_FALSE(v.state.view.placing);
    ASSERT_EQ(v.state.requests.size(), 1u);
    EXPECT_EQ(v.state.requests[0].kind, Request::Kind::AddFile);
    EXPECT_EQ(v.state.requests[0].path, "shape:sphere");
    EXPECT_EQ(v.state.requests[0].place, shapeAtPixel(v.state, pixel));
    runAction(v.state, actionById("add.box"));
    v.ui.tap(key::kEscape);
    v.ui.frames(v.state);
    EXPECT_FALSE(v.state.view.placing);
    EXPECT_EQ(v.state.requests.size(), 1u);
}

} // namespace
} // namespace limn::added_file_test
