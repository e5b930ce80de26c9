// SPDX-License-Identifier: MIT
#include "editor_ui/panels/action.h"

#include "editor_ui/document/document_edit.h"
#include "tests/editor_ui/headless.h"

#include <functional>
#include <set>

#include <gtest/gtest.h>

namespace limn::action_test {
namespace {

void runAllActionsOneByOne(const std::function<EditorState()>& make) {
    for (const Action& action : actions()) {
        SCOPED_TRACE(action.id);
        HeadlessUi ui;
        EditorState state = make();
        const auto before = state.document;
        ui.frames(state);
        runAction(state, action);
        ui.frames(state);
        ui.frames(state);
        commitGesture(state);
        while (undoEdit(state)) {
        }
        EXPECT_EQ(state.document, before);
    }
}

TEST(Actions, EveryActionCanBeCalledOnAnEmptyDocument) {
    runAllActionsOneByOne(emptyEditor);
}

TEST(Actions, EveryActionCanBeCalledOnAFullDocumentWithEverythingSelected) {
    runAllActionsOneByOne([] {
        EditorState state = fullEditor();
        for (const auto& [id, object] : state.document.objects)
            state.selection.push_back(id);
        return state;
    });
}

TEST(Actions, NoTwoActionsShareAnIdOrAKey) {
    std::set<std::string> ids;
    std::set<std::pair<int, int>> keys;
    for (const Action& action : actions()) {
        EXPECT_TRUE(ids.insert(action.id).second) << action.id;
        for (const Shortcut& s : {action.shortcut, action.alternative})
            if (s.key != key::kNone) {
                EXPECT_TRUE(keys.emplace(s.key, s.mods).second) << action.id;
            }
    }
}

TEST(Actions, KeysOfTheConventionsDoWhatTheyPromise) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    state.selection = {idNamed(state, "Lamp")};
    const auto before = state.document.objects;
    ui.frames(state);
    ui.tap(key::of('D'), kCtrl);
    ui.frames(state);
    EXPECT_EQ(state.document.objects.size(), before.size() + 1);
    ui.tap(key::kDelete);
    ui.frames(state);
    EXPECT_EQ(state.document.objects, before);
    ui.tap(key::of('Z'), kCtrl);
    ui.tap(key::of('Z'), kCtrl);
    ui.frames(state);
    EXPECT_EQ(state.document.objects, before);
    ui.tap(key::of('Z'), kCtrl | kShift);
    ui.frames(state);
    EXPECT_EQ(state.document.objects.size(), before.size() + 1);
    ui.tap(key::of('S'), kCtrl);
    ui.frames(state);
    EXPECT_TRUE(state.fileBrowser); // never saved: asks where
}

TEST(Actions, RenameTakesTheTypedName) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    const ObjectId id = idNamed(state, "Lamp");
    state.selection = {id};
    ui.frames(state);
    ui.tap(key::kF2);
    ui.frames(state);
    ui.frames(state);
    ui.frames(state);
    for (char c : {'K', 'e', 'y'})
        ui.input.events.push_back({.kind = InputEvent::Kind::Character, .code = c});
    ui.frames(state);
    ui.tap(key::kEnter);
    ui.frames(state);
    EXPECT_EQ(objectName(state.document.objects.at(id)), "Key");
    ASSERT_EQ(state.history.edits.size(), 1u);
    EXPECT_EQ(state.history.edits[0].label, "Rename Lamp");
}

struct PaletteTest : testing::Test {
    HeadlessUi ui;
    EditorState state = fullEditor();

    PaletteTest() {
        ui.mouse(600, 300);
        ui.frames(state);
    }

    /// Opens the palette and types its filter.
    void openAndType(const std::string& filter) {
        ui.tap(key::of('P'), kCtrl);
        settle();
        for (char c : filter) {
            ui.tap(c == ' ' ? key::kSpace : key::of(char(c - 32)));
            ui.input.events.push_back({.kind = InputEvent::Kind::Character, .code = c});
            ui.frames(state);
        }
    }

    void settle() {
        for (int i = 0; i < 4; ++i)
            ui.frames(state);
    }
};

TEST_F(PaletteTest, RunsTheFirstActionThatMatchesOnEnter) {
    openAndType("sun");
    ui.tap(key::kEnter);
    settle();
    ASSERT_EQ(state.history.edits.size(), 1u);
    EXPECT_EQ(state.history.edits[0].label, "Add Sun 2");
}

TEST_F(PaletteTest, ArrowKeysChooseTheAction) {
    openAndType("from the"); // front, back, right, left, top
    for (int k : {key::kUp, key::kDown, key::kDown, key::kDown, key::kUp})
        ui.tap(k);
    ui.tap(key::kEnter);
    settle();
    const glm::vec3 toEye = state.view.camera.eye - state.view.camera.target;
    EXPECT_GT(toEye.x, 1); // "From the right"
    EXPECT_NEAR(toEye.z, 0, 1e-3f);
}

TEST(Actions, UndoNamesWhatItWouldUndo) {
    EditorState state = fullEditor();
    EXPECT_EQ(actionLabel(state, actionById("edit.undo")), "Undo");
    runAction(state, actionById("add.sun"));
    EXPECT_EQ(actionLabel(state, actionById("edit.undo")), "Undo Add Sun 2");
    runAction(state, actionById("edit.undo"));
    EXPECT_EQ(actionLabel(state, actionById("edit.redo")), "Redo Add Sun 2");
}

} // namespace
} // namespace limn::action_test
