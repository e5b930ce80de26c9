// SPDX-License-Identifier: MIT
#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/manipulation.h"
#include "editor_ui/document/selection.h"

#include "tests/editor_ui/headless.h"

#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::document_edit_test {
namespace {

struct DocumentEditTest : testing::Test {
    EditorState state = fullEditor();
    Document before = state.document;

    void select(std::initializer_list<const char*> names) {
        state.selection.clear();
        for (const char* name : names)
            state.selection.push_back(idNamed(state, name));
    }
    template <class T>
    T& get(const char* name) {
        return std::get<T>(state.document.objects.at(idNamed(state, name)));
    }
    void expectOneUndoStep() {
        EXPECT_EQ(state.history.edits.size(), 1u);
        EXPECT_TRUE(undoEdit(state));
        EXPECT_EQ(state.document, before);
        EXPECT_TRUE(redoEdit(state));
        EXPECT_NE(state.document, before);
    }
};

TEST_F(DocumentEditTest, DeletingANodeDeletesWhatIsBelowIt) {
    select({"Group"});
    deleteSelection(state);
    EXPECT_EQ(state.document.objects.size(), before.objects.size() - 3);
    EXPECT_TRUE(state.selection.empty());
    expectOneUndoStep();
}

TEST_F(DocumentEditTest, DuplicatingANodeCopiesItsTreeUnderNewIds) {
    select({"Group"});
    duplicateSelection(state);
    ASSERT_EQ(state.selection.size(), 1u);
    int below = 0;
    for (const auto& [id, object] : state.document.objects)
        if (const auto* node = std::get_if<Node>(&object))
            below += node->parent == state.selection[0];
    EXPECT_EQ(below, 2);
    EXPECT_EQ(objectName(state.document.objects.at(state.selection[0])), "Group 2");
    expectOneUndoStep();
}

TEST_F(DocumentEditTest, MaterialsSkyAndSettingsAreNeitherDeletedNorDuplicated) {
    select({"Stone", "Sky", "Bake settings"});
    deleteSelection(state);
    duplicateSelection(state);
    EXPECT_EQ(state.document, before);
    EXPECT_TRUE(state.history.edits.empty());
}

TEST_F(DocumentEditTest, HidingTurnsLightsOffAndNodesInvisibleInOneStep) {
    select({"Lamp", "Left"});
    toggleHidden(state);
    EXPECT_FALSE(get<Light>("Lamp").enabled);
    EXPECT_FALSE(get<Node>("Left").visible);
    expectOneUndoStep();
    toggleHidden(state);
    EXPECT_TRUE(get<Light>("Lamp").enabled);
    toggleHidden(state);
    showAll(state);
    EXPECT_EQ(state.document.objects, before.objects);
}

TEST_F(DocumentEditTest, AProfileBringsItsIntensityAndMakesALightAPoint) {
    const LightProfile profile{
        .name = "Lamp", .peak = 321, .rows = 2, .columns = 1, .share = {1, 0}};
    setLightProfile(state, idNamed(state, "Torch"), profile);
    EXPECT_EQ(get<Light>("Torch").kind, LightKind::Spot);
    EXPECT_EQ(get<Light>("Torch").strength, 321);
    EXPECT_EQ(*get<Light>("Torch").profile, profile);
    expectOneUndoStep();
    setLightProfile(state, idNamed(state, "Panel"), profile);
    EXPECT_EQ(get<Light>("Panel").kind, LightKind::Point);
    setLightProfile(state, idNamed(state, "Group"), profile);
    EXPECT_EQ(state.history.edits.size(), 2u); // a group has none
}

TEST_F(DocumentEditTest, NewLightsHaveNamesOfTheirOwn) {
    for (int i = 0; i < 4; ++i)
        addLight(state, Light{.name = "Lamp"});
    std::set<std::string> names;
    for (const auto& [id, object] : state.document.objects)
        names.insert(objectName(object));
    EXPECT_EQ(names.size(), state.document.objects.size());
    EXPECT_TRUE(names.contains("Lamp 5"));
}

TEST_F(DocumentEditTest, WhatLiesFarAwayIsEditedAboutTheScenesOrigin) {
    const glm::mat4 near = worldMatrix(state.document, idNamed(state, "Left"));
    state.document.origin = {1e7, 0, -1e7};
    get<Node>("Group").transform.translation += state.document.origin;
    select({"Left"});
    EXPECT_EQ(worldMatrix(state.document, idNamed(state, "Left")), near);
    state.view.gizmoPlace = GizmoPlace::Origins;
    EXPECT_EQ(selectionOrigin(state), glm::vec3(near[3]));

    select({"Group"});
    Object& group = state.document.objects.at(idNamed(state, "Group"));
    group = manipulated(state.document, group, {.move = {0.01f, 0, 0}});
    ASSERT_TRUE(selectionOrigin(state));
    EXPECT_NEAR(selectionOrigin(state)->x, 0.01f, 1e-6f);
}

TEST_F(DocumentEditTest, ACycleOfParentsDoesNotHang) {
    get<Node>("Group").parent = idNamed(state, "Left");
    worldMatrix(state.document, idNamed(state, "Right"));
    select({"Group"});
    deleteSelection(state);
    SUCCEED();
}

} // namespace
} // namespace limn::document_edit_test
