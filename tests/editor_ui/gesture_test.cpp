// SPDX-License-Identifier: MIT
#include "editor_ui/document/gesture.h"

#include "tests/editor_ui/headless.h"

#include <gtest/gtest.h>

namespace limn::gesture_test {
namespace {

struct GestureTest : testing::Test {
    EditorState state = fullEditor();
    ObjectId id = idNamed(state, "Lamp");
    Light& light = std::get<Light>(state.document.objects.at(id));
    Object seen = light;
    float first = light.strength;

    void setStrength(float value, const char* label) {
        light.strength = value;
        trackEdit(state, id, seen, label);
    }
};

TEST_F(GestureTest, ManyEditsAreOneStep) {
    setStrength(2, "Strength");
    setStrength(3, "Strength");
    commitGesture(state);
    ASSERT_EQ(state.history.edits.size(), 1u);
    EXPECT_TRUE(undo(state.history, state.document));
    EXPECT_EQ(light.strength, first);
}

TEST_F(GestureTest, ReturningToTheStartIsNoEdit) {
    setStrength(2, "Strength");
    setStrength(first, "Strength");
    commitGesture(state);
    EXPECT_TRUE(state.history.edits.empty());
}

TEST_F(GestureTest, CancellingBringsTheStartBackWithoutAnEdit) {
    const Document before = state.document;
    setStrength(2, "Strength");
    setStrength(3, "Strength");
    cancelGesture(state);
    EXPECT_EQ(state.document, before);
    EXPECT_FALSE(state.gesture);
    EXPECT_TRUE(state.history.edits.empty());
}

TEST_F(GestureTest, AnotherWidgetEndsTheGesture) {
    setStrength(2, "Strength");
    setStrength(3, "Flux");
    commitGesture(state);
    ASSERT_EQ(state.history.edits.size(), 2u);
    undo(state.history, state.document);
    EXPECT_EQ(light.strength, 2);
    undo(state.history, state.document);
    EXPECT_EQ(light.strength, first);
    redo(state.history, state.document);
    EXPECT_EQ(light.strength, 2); // each edit ends where the next begins
}

TEST_F(GestureTest, AnotherObjectEndsTheGesture) {
    setStrength(2, "Strength");
    const ObjectId other = idNamed(state, "Torch");
    Object otherSeen = state.document.objects.at(other);
    std::get<Light>(state.document.objects.at(other)).strength = 7;
    trackEdit(state, other, otherSeen, "Strength");
    commitGesture(state);
    ASSERT_EQ(state.history.edits.size(), 2u);
    EXPECT_EQ(state.history.edits[0].changes[0].id, id);
    EXPECT_EQ(state.history.edits[1].changes[0].id, other);
}

TEST_F(GestureTest, SeveralObjectsMovedTogetherAreOneStep) {
    const ObjectId other = idNamed(state, "Torch");
    ObjectsById both{{id, state.document.objects.at(id)},
                     {other, state.document.objects.at(other)}};
    const Document before = state.document;
    for (int i = 0; i < 3; ++i) {
        for (auto& [objectId, object] : both)
            std::get<Light>(state.document.objects.at(objectId)).position.x += 1;
        trackEdits(state, both, "Move");
    }
    commitGesture(state);
    ASSERT_EQ(state.history.edits.size(), 1u);
    EXPECT_EQ(state.history.edits[0].changes.size(), 2u);
    undo(state.history, state.document);
    EXPECT_EQ(state.document, before);
}

} // namespace
} // namespace limn::gesture_test
