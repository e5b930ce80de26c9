// SPDX-License-Identifier: MIT
#include "editor_ui/view/input_queue.h"

#include "tests/editor_ui/headless.h"

#include <imgui.h>

#include <gtest/gtest.h>

namespace limn::input_queue_test {
namespace {

/// Runs the queue dry and counts the frames on which ImGui saw a click at `at`.
int clicksSeen(HeadlessUi& ui, glm::vec2 at) {
    int clicks = 0;
    do {
        feedInput(ui.input);
        ImGui::NewFrame();
        const ImVec2 m = ImGui::GetIO().MousePos;
        clicks += ImGui::IsMouseClicked(0) && m.x == at.x && m.y == at.y;
        ImGui::EndFrame();
    } while (!ui.input.events.empty());
    return clicks;
}

TEST(InputQueue, AClickShorterThanAFrameIsSeenWhereItHappened) {
    HeadlessUi ui;
    ui.mouse(10, 20);
    ui.button(true);
    ui.button(false);
    ui.mouse(300, 200);
    EXPECT_EQ(clicksSeen(ui, {10, 20}), 1);
    EXPECT_EQ(ImGui::GetIO().MousePos.x, 300);
}

TEST(InputQueue, EveryTapOfAKeyIsReportedOnceWithItsModifiers) {
    HeadlessUi ui;
    ui.tap(key::of('Z'), kCtrl);
    ui.tap(key::of('Z'), kCtrl | kShift);
    ui.tap(key::kLeftShift, kShift);
    std::vector<Shortcut> all;
    do {
        for (const Shortcut& s : feedInput(ui.input))
            all.push_back(s);
        ImGui::NewFrame();
        ImGui::EndFrame();
    } while (!ui.input.events.empty());
    const std::vector<Shortcut> expected{{key::of('Z'), kCtrl}, {key::of('Z'), kCtrl | kShift}};
    EXPECT_EQ(all, expected);
}

TEST(InputQueue, AllMovesFitOneFrameAndAPressComesInTheNext) {
    HeadlessUi ui;
    for (int i = 0; i < 10; ++i)
        ui.mouse(float(i), 0);
    ui.button(true);
    feedInput(ui.input);
    EXPECT_EQ(ImGui::GetIO().MousePos.x, 9);
    EXPECT_EQ(ui.input.events.size(), 1u);
    feedInput(ui.input);
    EXPECT_TRUE(ui.input.events.empty());
}

TEST(Keys, ShortcutsReadAsTheManualsWriteThem) {
    EXPECT_EQ(shortcutText({key::of('Z'), kCtrl | kShift}), "Ctrl-Shift-Z");
    EXPECT_EQ(shortcutText({key::kF12, kNoMods}), "F12");
    EXPECT_EQ(shortcutText({key::kPad7, kCtrl}), "Ctrl-Numpad 7");
    EXPECT_EQ(shortcutText({}), "");
}

} // namespace
} // namespace limn::input_queue_test
