// SPDX-License-Identifier: MIT
// Edits of the tree, the clipboard, and edits of many objects at once.
#include "editor_ui/document/tree_edit.h"

#include "editor_ui/document/clipboard.h"
#include "editor_ui/document/common_edit.h"
#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/object_rules.h"
#include "editor_ui/panels/action.h"
#include "tests/editor_ui/headless.h"

#include <imgui.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::tree_edit_test {
namespace {

struct TreeEditTest : testing::Test {
    EditorState state = fullEditor();
    const Document before = state.document;

    ObjectId id(const char* name) const { return idNamed(state, name); }
    void select(std::initializer_list<const char*> names) {
        state.selection.clear();
        for (const char* name : names)
            state.selection.push_back(id(name));
    }
    template <class T>
    T& get(const char* name) {
        return std::get<T>(state.document.objects.at(id(name)));
    }
    glm::mat4 world(const char* name) const { return worldMatrix(state.document, id(name)); }
    ObjectId addRoot(const char* name, Transform transform) {
        Node node;
        node.name = name;
        node.transform = transform;
        return addObject(state.document, node);
    }
    void expectOneUndoStep(const Document& start) {
        ASSERT_EQ(state.history.edits.size(), 1u);
        const Document after = state.document;
        EXPECT_NE(after, start);
        EXPECT_TRUE(undoEdit(state));
        EXPECT_EQ(state.document, start);
        EXPECT_TRUE(redoEdit(state));
        EXPECT_EQ(state.document, after);
    }
};

float difference(const glm::mat4& a, const glm::mat4& b) {
    float most = 0;
    for (int c = 0; c < 4; ++c)
        most = std::max(most, glm::length(a[c] - b[c]));
    return most;
}

const Transform kTurned{
    {1, -2, 0.5}, glm::normalize(glm::quat(0.8f, 0.3f, -0.4f, 0.1f)), glm::vec3(0.5f)};

TEST_F(TreeEditTest, GroupingSiblingsKeepsThemWhereTheyAre) {
    const glm::mat4 left = world("Left"), right = world("Right");
    select({"Left", "Right", "Lamp"});
    groupSelection(state);
    const Node& group = get<Node>("Group 2");
    EXPECT_EQ(group.parent, id("Group"));
    EXPECT_EQ(get<Node>("Left").parent, id("Group 2"));
    EXPECT_EQ(get<Node>("Right").parent, id("Group 2"));
    EXPECT_EQ(world("Left"), left);
    EXPECT_EQ(world("Right"), right);
    EXPECT_EQ(state.selection, std::vector{id("Group 2")});
    expectOneUndoStep(before);
}

TEST_F(TreeEditTest, GroupingAcrossParentsKeepsEachWhereItIs) {
    addRoot("Loose", kTurned);
    const Document start = state.document;
    const glm::mat4 left = world("Left"), loose = world("Loose");
    select({"Left", "Loose"});
    groupSelection(state);
    EXPECT_EQ(get<Node>("Group 2").parent, 0u);
    EXPECT_LT(difference(world("Left"), left), 1e-5f);
    EXPECT_LT(difference(world("Loose"), loose), 1e-5f);
    expectOneUndoStep(start);
}

TEST_F(TreeEditTest, UngroupingFreesTheChildrenAndKeepsWhatTheGroupSaid) {
    Node& group = get<Node>("Group");
    group.transform.rotation = kTurned.rotation;
    group.visible = false;
    group.dynamic = true;
    group.texelDensity = 4;
    get<Node>("Left").texelDensity = 0.5f;
    const Document start = state.document;
    const glm::mat4 left = world("Left");
    select({"Group"});
    ASSERT_TRUE(canUngroup(state));
    ungroupSelection(state);
    EXPECT_EQ(state.document.objects.size(), start.objects.size() - 1);
    EXPECT_EQ(get<Node>("Left").parent, 0u);
    EXPECT_LT(difference(world("Left"), left), 1e-5f);
    EXPECT_FALSE(get<Node>("Left").visible);
    EXPECT_TRUE(get<Node>("Right").dynamic);
    EXPECT_EQ(get<Node>("Left").texelDensity, 2);
    EXPECT_EQ(get<Node>("Right").texelDensity, 4);
    EXPECT_EQ(state.selection, (std::vector{id("Left"), id("Right")}));
    expectOneUndoStep(start);
    select({"Left"});
    EXPECT_FALSE(canUngroup(state)) << "an object is no group";
}

TEST_F(TreeEditTest, AMirroredParentIsLeftAndEnteredWithoutATrace) {
    Node& group = get<Node>("Group");
    group.transform = kTurned;
    group.transform.scale = {0.5f, -0.5f, 0.5f};
    const glm::mat4 left = world("Left");
    const Transform inside = get<Node>("Left").transform;
    reparent(state, {id("Left")}, 0);
    EXPECT_LT(difference(world("Left"), left), 1e-5f);
    reparent(state, {id("Left")}, id("Group"));
    EXPECT_LT(difference(world("Left"), left), 1e-5f);
    EXPECT_NEAR(glm::length(get<Node>("Left").transform.translation - inside.translation), 0, 1e-5);
}

TEST_F(TreeEditTest, AShearingParentKeepsThePlaceAndAValidTransform) {
    Node& group = get<Node>("Group");
    group.transform.scale = {5, 1, 0.2f};
    get<Node>("Left").transform = kTurned;
    const glm::vec3 at = world("Left")[3];
    reparent(state, {id("Left")}, 0);
    EXPECT_NEAR(glm::length(glm::vec3(world("Left")[3]) - at), 0, 1e-5f);
    EXPECT_TRUE(isValid(state.document.objects.at(id("Left"))));
}

TEST_F(TreeEditTest, NothingComesBelowItself) {
    reparent(state, {id("Group")}, id("Left"));
    reparent(state, {id("Group")}, id("Group"));
    reparent(state, {id("Lamp")}, id("Left"));
    reparent(state, {id("Left")}, id("Lamp"));
    reparent(state, {id("Left")}, id("Group")); // is there already
    EXPECT_EQ(state.document, before);
    EXPECT_TRUE(state.history.edits.empty());
}

TEST_F(TreeEditTest, WhatIsCopiedCanBePastedAgainAndAgain) {
    select({"Group", "Torch"});
    copySelection(state);
    EXPECT_EQ(state.document, before);
    pasteClipboard(state);
    EXPECT_EQ(state.selection, (std::vector{id("Group 2"), id("Torch 2")}));
    EXPECT_EQ(get<Node>("Left 2").parent, id("Group 2"));
    expectOneUndoStep(before);
    pasteClipboard(state);
    EXPECT_EQ(state.document.objects.size(), before.objects.size() + 8);
}

TEST_F(TreeEditTest, CutIsOneStepAndWhatWasCutCanBePastedBelowNoParent) {
    select({"Left"});
    cutSelection(state);
    EXPECT_EQ(state.document.objects.size(), before.objects.size() - 1);
    expectOneUndoStep(before);
    select({"Group"});
    deleteSelection(state);
    pasteClipboard(state);
    EXPECT_EQ(get<Node>("Left").parent, 0u);
}

TEST_F(TreeEditTest, AnotherSceneGetsLightsAtTheSamePlaceOfTheFileAndNoNodes) {
    select({"Left", "Torch"});
    copySelection(state);
    const glm::vec3 at = get<Light>("Torch").position;
    EditorState other = emptyEditor();
    other.document.sceneHash = state.document.sceneHash + 1;
    other.document.origin = {10, 0, -4};
    other.clipboard = state.clipboard;
    ASSERT_TRUE(canPaste(other));
    pasteClipboard(other);
    ASSERT_EQ(other.document.objects.size(), 1u);
    EXPECT_EQ(std::get<Light>(other.document.objects.begin()->second).position,
              at - glm::vec3(10, 0, -4));
    select({"Left"});
    copySelection(state);
    other.clipboard = state.clipboard;
    EXPECT_FALSE(canPaste(other));
}

TEST_F(TreeEditTest, IsolatingHidesTheOthersAndTheSameKeyShowsThem) {
    addRoot("Loose", {});
    get<Node>("Loose").meshes = {0};
    addRoot("Hidden", {});
    get<Node>("Hidden").meshes = {0};
    get<Node>("Hidden").visible = false;
    const Document start = state.document;
    select({"Left"});
    toggleIsolated(state);
    EXPECT_TRUE(get<Node>("Left").visible);
    EXPECT_TRUE(get<Node>("Group").visible) << "it would hide what is below";
    EXPECT_FALSE(get<Node>("Right").visible);
    EXPECT_FALSE(get<Node>("Loose").visible);
    EXPECT_TRUE(isIsolated(state));
    expectOneUndoStep(start);
    toggleIsolated(state);
    EXPECT_EQ(state.document, start) << "what was hidden before stays so";
    EXPECT_FALSE(isIsolated(state));
    EXPECT_EQ(state.history.edits.size(), 2u);
}

TEST_F(TreeEditTest, TheOthersAreShownAgainAfterOneOfThemWasDeleted) {
    addRoot("Loose", {});
    get<Node>("Loose").meshes = {0};
    select({"Left"});
    toggleIsolated(state);
    select({"Loose"});
    deleteSelection(state);
    toggleIsolated(state);
    EXPECT_TRUE(get<Node>("Right").visible);
    EXPECT_FALSE(isIsolated(state));
}

TEST_F(TreeEditTest, StaticObjectsBecomeDynamicTogether) {
    get<Node>("Left").dynamic = true;
    const Document start = state.document;
    select({"Left", "Right", "Lamp"});
    toggleDynamic(state);
    EXPECT_TRUE(get<Node>("Left").dynamic);
    EXPECT_TRUE(get<Node>("Right").dynamic);
    expectOneUndoStep(start);
    toggleDynamic(state);
    EXPECT_FALSE(get<Node>("Left").dynamic);
    EXPECT_FALSE(get<Node>("Right").dynamic);
}

TEST(CommonEdit, OnlyWhatChangedIsCopiedAndPositionsMoveByAsMuch) {
    Light a, b;
    a.position = {1, 2, 3};
    b.name = "Other";
    b.position = {5, 5, 5};
    b.strength = 7;
    b.color = {0.1f, 0.2f, 0.3f};
    Light after = a;
    after.name = "New name";
    after.position.x += 2;
    after.color.y = 0.9f;
    Object other = b;
    copyChanges(a, after, other);
    Light expected = b;
    expected.position.x = 7;
    expected.color.y = 0.9f;
    EXPECT_EQ(std::get<Light>(other), expected);
    Object node = Node{};
    copyChanges(a, after, node);
    EXPECT_EQ(node, Object(Node{}));
}

TEST(CommonEdit, GlassIsCopiedFieldByField) {
    Material a, b;
    a.ior = b.ior = 1.7f;
    b.transmission = 0.25f;
    b.roughness = 0.1f;
    for (float Material::*field : {&Material::transmission, &Material::ior, &Material::thickness}) {
        Material after = a, expected = b;
        after.*field = 1;
        expected.*field = 1;
        Object other = b;
        copyChanges(a, after, other);
        EXPECT_EQ(std::get<Material>(other), expected);
    }
}

/// Ticks the box "On", which is the first field below the name of a light.
TEST(CommonEdit, TheInspectorEditsAllSelectedLightsInOneStep) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    const Document before = state.document;
    state.selection = {idNamed(state, "Torch"), idNamed(state, "Left"), idNamed(state, "Lamp")};
    const auto isOn = [&](const char* name) {
        return std::get<Light>(state.document.objects.at(idNamed(state, name))).enabled;
    };
    for (int i = 0; i < 4; ++i)
        ui.frames(state);
    const float x = ImGui::GetIO().DisplaySize.x - state.layout.right * 0.54f;
    for (float y = 60; y < 260 && isOn("Lamp"); y += 4) {
        state.closedCards.clear(); // by a click on a card's header
        ui.mouse(x, y);
        ui.frames(state);
        ui.button(true);
        ui.frames(state);
        ui.button(false);
        for (int i = 0; i < 3; ++i)
            ui.frames(state);
    }
    EXPECT_FALSE(isOn("Lamp"));
    EXPECT_FALSE(isOn("Torch"));
    EXPECT_TRUE(isOn("Sun"));
    ASSERT_EQ(state.history.edits.size(), 1u);
    EXPECT_EQ(state.history.edits[0].changes.size(), 2u);
    undoEdit(state);
    EXPECT_EQ(state.document, before);
}

/// A row of the list is dragged onto another one.
TEST(OutlinerDrag, PutsANodeBelowAnother) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    reparent(state, {idNamed(state, "Right")}, 0);
    state.history = {};
    const Document before = state.document;
    const ObjectId left = idNamed(state, "Left"), right = idNamed(state, "Right");
    const auto settle = [&] {
        for (int i = 0; i < 4; ++i)
            ui.frames(state);
    };
    settle();
    const auto rowOf = [&](ObjectId id) {     // by clicking, as a user finds it
        for (float y = 40; y < 400; y += 7) { // nearer ones would be double clicks
            state.selection.clear();
            state.outliner.closed.clear(); // a click on a heading closes its section
            state.outliner.collapsed.clear();
            ui.mouse(120, y);
            ui.frames(state);
            ui.button(true);
            ui.frames(state);
            ui.button(false);
            settle();
            if (state.selection == std::vector{id})
                return y + 4;
        }
        return 0.f;
    };
    const float from = rowOf(right), to = rowOf(left);
    ASSERT_GT(from, 0);
    ASSERT_GT(to, 0);
    ui.mouse(120, from);
    ui.frames(state);
    ui.button(true);
    ui.frames(state);
    for (float t : {0.3f, 0.7f, 1.f}) {
        ui.mouse(120, from + (to - from) * t);
        settle();
    }
    ui.button(false);
    settle();
    EXPECT_EQ(std::get<Node>(state.document.objects.at(right)).parent, left);
    ASSERT_EQ(state.history.edits.size(), 1u);
    undoEdit(state);
    EXPECT_EQ(state.document, before);
}

} // namespace
} // namespace limn::tree_edit_test
