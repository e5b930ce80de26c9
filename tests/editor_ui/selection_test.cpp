// SPDX-License-Identifier: MIT
#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/material_edit.h"
#include "editor_ui/document/selection.h"
#include "editor_ui/view/picking.h"
#include "tests/editor_ui/cornell_view.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::selection_test {
namespace {

struct SelectionTest : testing::Test {
    EditorState state = fullEditor();

    void select(std::initializer_list<const char*> names) {
        state.selection.clear();
        for (const char* name : names)
            state.selection.push_back(idNamed(state, name));
    }
};

TEST_F(SelectionTest, AChildOfASelectedNodeIsNotMovedTwice) {
    select({"Group", "Left", "Lamp"});
    const auto movable = movableSelection(state);
    EXPECT_EQ(movable.size(), 2u);
    EXPECT_FALSE(movable.contains(idNamed(state, "Left")));
}

TEST_F(SelectionTest, ItsBoxIsThatOfItsMeshesInTheWorld) {
    select({"Group"}); // scaled by 2 and lifted by 1
    const Bounds b = selectionBounds(state);
    EXPECT_EQ(b.lower, glm::vec3(-2, -1, 0));
    EXPECT_EQ(b.upper, glm::vec3(2, 3, 0));
}

TEST_F(SelectionTest, TheGizmoStandsInTheMiddleOfWhatIsSelectedOrAtItsOrigin) {
    std::get<Node>(state.document.objects.at(idNamed(state, "Left"))).transform.translation = {
        50, 0, 0};
    state.meshBounds = {{{-51, -1, 0}, {-49, 1, 0}}}; // the mesh lies far from its origin
    select({"Left"});
    EXPECT_EQ(selectionOrigin(state), glm::vec3(0, 1, 0));
    state.view.gizmoPlace = GizmoPlace::Origins;
    EXPECT_EQ(selectionOrigin(state), glm::vec3(100, 1, 0));
}

TEST_F(SelectionTest, TheGizmoStandsWhereTheActiveObjectWasClicked) {
    select({"Left"});
    state.view.gizmoPlace = GizmoPlace::Click;
    EXPECT_EQ(selectionOrigin(state), glm::vec3(0, 1, 0)); // nothing was clicked
    state.view.picked = PickedSurface{idNamed(state, "Left"), 0, {0.5f, 1.5f, 0}};
    EXPECT_EQ(selectionOrigin(state), glm::vec3(0.5f, 1.5f, 0));
    select({"Right"});
    EXPECT_EQ(pickedSurface(state), nullptr);
    EXPECT_EQ(selectionOrigin(state), glm::vec3(0, 1, 0));
}

TEST_F(SelectionTest, AMeshsMaterialIsTheOneOfItsNumberInTheDocument) {
    auto assets = std::make_shared<Assets>(*state.assets);
    assets->meshes[0].material = 1;
    state.assets = assets;
    const Node node{.meshes = {0, 7}};
    EXPECT_EQ(materialOf(state, node, 0), idNamed(state, "Glow"));
    assets->meshes[0].material = 2;
    EXPECT_EQ(materialOf(state, node, 0), 0u);
    EXPECT_EQ(materialOf(state, node, 1), 0u);
    EXPECT_EQ(materialOf(state, node, 2), 0u);
}

/// Many objects cost about as many steps, not their square: 20 000 would take minutes.
TEST_F(SelectionTest, TwentyThousandSelectedObjectsAreFoundAtOnce) {
    for (int i = 0; i < 20000; ++i)
        state.selection.push_back(addObject(state.document, Node{.name = "obj", .meshes = {0}}));
    EXPECT_EQ(movableSelection(state).size(), 20000u);
    EXPECT_EQ(selectionWithChildren(state).size(), 20000u);
    EXPECT_TRUE(selectionOrigin(state));
}

TEST(Picking, AClickFindsTheMeshAndItsMaterial) {
    CornellView v;
    const glm::vec2 pixel = v.at(0.5f, 0.5f);
    pick(v.state, pixel, false);
    ASSERT_EQ(v.state.selection.size(), 1u);
    const PickedSurface* picked = pickedSurface(v.state);
    ASSERT_TRUE(picked);
    const auto& node = std::get<Node>(v.state.document.objects.at(picked->node));
    EXPECT_NE(std::ranges::find(node.meshes, picked->mesh), node.meshes.end());
    EXPECT_TRUE(std::holds_alternative<Material>(
        v.state.document.objects.at(materialOf(v.state, node, 0))));
    const glm::vec2 back = *toPixel(v.state.view.picture(), picked->position);
    EXPECT_NEAR(glm::length(back - pixel), 0, 0.05f);
    v.ui.frames(v.state); // the inspector shows the mesh and its material
}

} // namespace
} // namespace limn::selection_test
