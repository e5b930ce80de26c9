// SPDX-License-Identifier: MIT
#include "editor_ui/panels/key_map.h"

#include "editor_ui/panels/action.h"
#include "tests/editor_ui/headless.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <imgui_internal.h>

namespace limn::key_map_test {
namespace {

constexpr Shortcut kAltU{key::of('U'), kAlt};

TEST(KeyText, IsReadAsItIsWritten) {
    int named = 0;
    for (int k = 0; k < 400; ++k)
        for (std::uint8_t mods = 0; mods < 8; ++mods) {
            const Shortcut shortcut{k, mods};
            if (const std::string text = shortcutText(shortcut); !text.empty()) {
                EXPECT_EQ(shortcutFromText(text), shortcut) << text;
                ++named;
            }
        }
    EXPECT_GT(named, 8 * 80);
    EXPECT_EQ(shortcutFromText(""), Shortcut{});
    for (const char* text : {"Ctrl", "Ctrl-", "Ctrl-Ctrl-A", "Shift-Ctrl-A", "a", "F13", " ", "AB"})
        EXPECT_FALSE(shortcutFromText(text)) << text;
}

TEST(KeyMap, ANewKeyRunsTheActionAndTheOldOneDoesNot) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    const auto before = state.document.objects;
    assignKey(state, actionById("edit.delete"), kAltU);
    state.selection = {idNamed(state, "Lamp")};
    ui.frames(state);
    ui.tap(key::kDelete);
    ui.frames(state);
    EXPECT_EQ(state.document.objects, before);
    ui.tap(key::of('U'), kAlt);
    ui.frames(state);
    EXPECT_EQ(state.document.objects.size(), before.size() - 1);
}

/// Expects that no two actions share a key.
void expectNoKeyTwice(const EditorState& state) {
    std::map<std::pair<int, int>, std::string> owner;
    for (const Action& action : actions())
        for (const Shortcut& s : shortcutsOf(state, action)) {
            const auto [at, isNew] = owner.emplace(std::pair(s.key, s.mods), action.id);
            EXPECT_TRUE(isNew) << action.id << " and " << at->second;
        }
}

TEST(KeyMap, TheActionThatHadTheKeyKeepsOnlyItsOther) {
    EditorState state = fullEditor();
    const Action& redo = actionById("edit.redo");
    const Action& bake = actionById("bake.start");
    assignKey(state, bake, redo.shortcut);
    EXPECT_EQ(shortcutsOf(state, bake), std::vector{redo.shortcut});
    EXPECT_EQ(shortcutsOf(state, redo), std::vector{redo.alternative});
    assignKey(state, bake, redo.alternative);
    EXPECT_TRUE(shortcutsOf(state, redo).empty());
    expectNoKeyTwice(state);
    state.view.gizmo.blenderKeys = true;
    assignKey(state, bake, {key::of('R'), kNoMods});
    expectNoKeyTwice(state);
    runAction(state, actionById("help.reset_keys"));
    EXPECT_EQ(shortcutsOf(state, redo), (std::vector{redo.shortcut, redo.alternative}));
    expectNoKeyTwice(state);
}

TEST(KeyMap, KeysOfDialogsAndTextsAreNotAssigned) {
    for (const int k : {key::kEscape, key::kEnter, key::kTab, key::kBackspace, key::kNone, 399})
        EXPECT_FALSE(isAssignable({k, kNoMods})) << k;
    EXPECT_TRUE(isAssignable(kAltU));
}

/// Opens the sheet of keys and lets the row of this action wait for a key.
void waitForKey(HeadlessUi& ui, EditorState& state, const char* id) {
    state.palette.helpAsked = true;
    ui.frames(state);
    state.palette.assigning = id;
    ui.frames(state);
}

TEST(HelpSheet, TakesTheNextKeyForAnAction) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    const Action& undo = actionById("edit.undo");
    waitForKey(ui, state, "edit.undo");
    ui.tap(key::kEscape);
    ui.frames(state);
    EXPECT_EQ(state.palette.assigning, "");
    EXPECT_TRUE(state.keys.empty()) << "Esc keeps the old key";
    EXPECT_TRUE(ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup)) << "and the sheet";
    waitForKey(ui, state, "edit.undo");
    ui.tap(key::kEnter);
    ui.frames(state);
    EXPECT_EQ(state.palette.assigning, "edit.undo") << "Enter is no key for it";
    ui.tap(key::of('U'), kAlt);
    ui.frames(state);
    EXPECT_EQ(shortcutsOf(state, undo), std::vector{kAltU});
    waitForKey(ui, state, "edit.undo");
    ui.tap(key::kBackspace);
    ui.frames(state);
    EXPECT_TRUE(shortcutsOf(state, undo).empty());
}

TEST(HelpSheet, AClickOnARowWaitsForItsKey) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    state.palette.helpAsked = true;
    ui.frames(state);
    ui.frames(state);
    const ImGuiWindow* sheet = ImGui::GetCurrentContext()->OpenPopupStack.front().Window;
    ASSERT_TRUE(sheet);
    for (float y = sheet->Pos.y; y < sheet->Pos.y + sheet->Size.y; y += 10) {
        ui.mouse(sheet->Pos.x + sheet->Size.x / 2, y);
        ui.button(true);
        ui.button(false);
        ui.frames(state);
        ui.frames(state);
        if (!state.palette.assigning.empty())
            return;
    }
    FAIL() << "no row took the click";
}

} // namespace
} // namespace limn::key_map_test
