// SPDX-License-Identifier: MIT
#include "editor_ui/view/gizmo_math.h"
#include "tests/editor_ui/headless.h"

#include <imgui.h>

#include <gtest/gtest.h>

namespace limn::escape_test {
namespace {

struct EscapeTest : testing::Test {
    HeadlessUi ui;
    EditorState state = fullEditor();
    const ObjectId lamp = idNamed(state, "Lamp");

    EscapeTest() {
        state.selection = {lamp};
        settle();
    }

    void settle() {
        for (int i = 0; i < 4; ++i)
            ui.frames(state);
    }

    void press(float x, float y) {
        ui.mouse(x, y);
        ui.frames(state);
        ui.button(true);
        ui.frames(state);
    }

    void moveTo(float x, float y) {
        ui.mouse(x, y);
        ui.frames(state);
    }

    void release() {
        ui.button(false);
        settle();
    }

    void escape() {
        ui.tap(key::kEscape);
        ui.frames(state);
    }

    static bool popupOpen() {
        return ImGui::IsPopupOpen(nullptr,
                                  ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    }
};

TEST_F(EscapeTest, TakesTheGizmosDragBack) {
    const Document before = state.document;
    const Picture picture = state.view.picture();
    const glm::vec3 origin = std::get<Light>(before.objects.at(lamp)).position;
    const glm::vec2 grip =
        *toPixel(picture, arrowTip(Handle::X, {origin}, 0.8f * arrowLength(picture, origin)));
    press(grip.x, grip.y);
    moveTo(grip.x + 60, grip.y);
    ASSERT_NE(state.document, before);
    escape();
    EXPECT_EQ(state.document, before);
    moveTo(grip.x + 90, grip.y); // the button is still held
    release();
    EXPECT_EQ(state.document, before);
    EXPECT_TRUE(state.history.edits.empty());
    EXPECT_EQ(state.selection, std::vector{lamp});
}

/// Drags in the inspector until something follows; there are about a dozen sliders.
TEST_F(EscapeTest, TakesEverySlidersDragBack) {
    const Document before = state.document;
    const float x = ImGui::GetIO().DisplaySize.x - state.layout.right * 0.4f;
    int dragged = 0;
    for (float y = 40; y < 600; y += 8) {
        state.closedCards.clear(); // by a click on a card's header
        press(x, y);
        moveTo(x + 25, y);
        if (state.gesture) {
            ++dragged;
            escape();
            EXPECT_EQ(state.document, before) << y;
            moveTo(x - 40, y);
            EXPECT_EQ(state.document, before) << y;
            release();
            EXPECT_TRUE(state.history.edits.empty()) << y;
        } else {
            release();
        }
        if (popupOpen()) {
            escape();
            settle();
        }
        state.document = before;
        state.history = {};
    }
    EXPECT_GE(dragged, 3);
}

TEST_F(EscapeTest, ClosesAMenuAndKeepsTheSelection) {
    press(20, 8);
    release();
    ASSERT_TRUE(popupOpen());
    escape();
    settle();
    EXPECT_FALSE(popupOpen());
    EXPECT_EQ(state.selection, std::vector{lamp});
    escape();
    EXPECT_TRUE(state.selection.empty());
}

TEST_F(EscapeTest, ClosesThePaletteAndKeepsTheSelection) {
    ui.mouse(600, 300);
    ui.tap(key::of('P'), kCtrl);
    settle();
    ASSERT_TRUE(popupOpen());
    escape();
    settle();
    EXPECT_FALSE(popupOpen());
    EXPECT_EQ(state.selection, std::vector{lamp});
}

} // namespace
} // namespace limn::escape_test
