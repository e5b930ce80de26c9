// SPDX-License-Identifier: MIT
#include "editor_ui/document/material_edit.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/panels/field.h"
#include "tests/editor_ui/headless.h"

#include <imgui_internal.h>

#include <gtest/gtest.h>

namespace limn::material_edit_test {
namespace {

struct MaterialEdit : testing::Test {
    EditorState state = fullEditor();
    ObjectId left = idNamed(state, "Left"), right = idNamed(state, "Right"),
             glow = idNamed(state, "Glow");
    ObjectsById first = state.document.objects;

    Node& node(ObjectId id) { return std::get<Node>(state.document.objects.at(id)); }
    Material& material(ObjectId id) { return std::get<Material>(state.document.objects.at(id)); }
    std::string shown(ObjectId id) {
        const Scene scene = flatten(state.document, state.assets);
        for (const Instance& i : scene.instances)
            if (i.node == id)
                return scene.materialOf(i).name;
        return "";
    }
    void expectUndone() {
        EXPECT_EQ(state.history.applied, 1u);
        undoEdit(state);
        EXPECT_TRUE(state.document.objects == first);
    }
};

TEST_F(MaterialEdit, AssigningIsOneStepForAllObjects) {
    ASSERT_NE(shown(left), "Glow");
    assignMaterial(state, {left, right}, glow);
    EXPECT_EQ(shown(left), "Glow");
    EXPECT_EQ(shown(right), "Glow");
    expectUndone();
    redoEdit(state);
    EXPECT_EQ(shown(right), "Glow");
}

TEST_F(MaterialEdit, WhatIsThereAlreadyIsNoEdit) {
    assignMaterial(state, {left}, materialOf(state, node(left), 0));
    assignMaterial(state, {left}, left); // no material
    assignMaterial(state, {glow}, glow); // no node
    setTexture(state, glow, TextureSlot::Normal, -1);
    EXPECT_TRUE(state.history.edits.empty());
    assignMaterial(state, {left}, glow);
    assignMaterial(state, {left}, glow);
    EXPECT_EQ(state.history.edits.size(), 1u);
}

TEST_F(MaterialEdit, OnePartOfAnObjectCanGetAMaterialOfItsOwn) {
    auto assets = std::make_shared<Assets>(*state.assets);
    assets->meshes.push_back(assets->meshes[0]);
    state.assets = assets;
    node(left).meshes = {0, 1};
    first = state.document.objects;
    const ObjectId before = materialOf(state, node(left), 0);
    ASSERT_NE(before, glow);
    assignMaterial(state, {left}, glow, 1);
    EXPECT_EQ(materialOf(state, node(left), 0), before);
    EXPECT_EQ(materialOf(state, node(left), 1), glow);
    expectUndone();
}

TEST_F(MaterialEdit, ANewMaterialIsAssignedInTheSameStep) {
    const ObjectId made = assignNewMaterial(state, {left, right}, 0);
    EXPECT_EQ(shown(left), material(made).name);
    EXPECT_EQ(materialOf(state, node(right), 0), made);
    expectUndone();
}

TEST_F(MaterialEdit, ACopyLeavesTheOriginalToTheOthers) {
    material(glow).roughness = 0.25f;
    first = state.document.objects;
    const ObjectId copy = assignNewMaterial(state, {left}, glow);
    EXPECT_EQ(material(copy).roughness, 0.25f);
    EXPECT_NE(material(copy).name, "Glow");
    EXPECT_EQ(materialOf(state, node(left), 0), copy);
    EXPECT_NE(materialOf(state, node(right), 0), copy);
    expectUndone();
}

TEST_F(MaterialEdit, TexturesComeAndGo) {
    for (const TextureSlot slot : kTextureSlots) {
        setTexture(state, glow, slot, 3);
        EXPECT_EQ(textureIn(material(glow), slot).image, 3);
        setTexture(state, glow, slot, -1);
        EXPECT_EQ(textureIn(material(glow), slot).image, -1);
    }
    EXPECT_EQ(state.history.edits.size(), 8u);
    while (undoEdit(state)) {
    }
    EXPECT_TRUE(state.document.objects == first);
}

TEST_F(MaterialEdit, AnEmissiveTextureOnADarkMaterialIsSeen) {
    const ObjectId dark = assignNewMaterial(state, {}, 0);
    setTexture(state, dark, TextureSlot::Emissive, 0);
    EXPECT_EQ(material(dark).emission, glm::vec3(1));
    const glm::vec3 before = material(glow).emission;
    ASSERT_NE(before, glm::vec3(0));
    setTexture(state, glow, TextureSlot::Emissive, 0);
    EXPECT_EQ(material(glow).emission, before);
}

TEST_F(MaterialEdit, MixedValuesAreFound) {
    node(right).dynamic = true;
    FieldEdit edit(state, left);
    EXPECT_FALSE(isMixed<Node>(edit, &Node::dynamic)); // one object alone is not mixed
    edit.others = {right};
    EXPECT_TRUE(isMixed<Node>(edit, &Node::dynamic));
    EXPECT_FALSE(isMixed<Node>(edit, &Node::visible));
    node(right).dynamic = false;
    EXPECT_FALSE(isMixed<Node>(edit, &Node::dynamic));
}

/// Where fields of the inspector begin, from the left [px]: at the widgets of a checkbox's row.
struct MixedMark : MaterialEdit {
    HeadlessUi ui;

    /// Vertices that the inspector draws.
    int vertices() {
        for (int i = 0; i < 3; ++i)
            ui.frames(state);
        for (ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
            if (std::string(window->Name) == "inspector")
                return window->DrawList->VtxBuffer.Size;
        return 0;
    }
};

TEST_F(MixedMark, IsDrawnWhereTheSelectedObjectsDiffer) {
    state.selection = {left, right};
    const int alike = vertices();
    ASSERT_GT(alike, 0);
    node(left).visible = false; // only the mark is drawn more: the value shown is that of "Right"
    EXPECT_GT(vertices(), alike);
    node(left).visible = true;
    EXPECT_EQ(vertices(), alike);
}

} // namespace
} // namespace limn::material_edit_test
