// SPDX-License-Identifier: MIT
#include "tests/editor_ui/headless.h"

#include <gtest/gtest.h>
#include <imgui_internal.h>

namespace limn::outliner_test {
namespace {

struct Outliner : testing::Test {
    HeadlessUi ui;
    EditorState state = fullEditor();

    /// Clicks the row of the list that is shown `row` rows below its first.
    void click(int row) {
        ui.frames(state);
        ImGuiWindow* list = nullptr;
        for (ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
            if (window->ParentWindow && std::string(window->ParentWindow->Name) == "outliner")
                list = window;
        ASSERT_TRUE(list);
        const float step = ImGui::GetFontSize() + ImGui::GetStyle().ItemSpacing.y;
        ui.mouse(list->Pos.x + 60, list->Pos.y + (float(row) + 0.5f) * step);
        ui.frames(state);
        ui.button(true);
        ui.frames(state);
        ui.button(false);
        ui.frames(state);
    }
};

TEST_F(Outliner, AClickOnAHeadingClosesItsSectionAndAnotherOpensIt) {
    click(0); // "Lights", with four of them
    EXPECT_EQ(state.outliner.closed, std::set<std::string>{"Lights"});
    click(1); // the next heading now
    EXPECT_EQ(state.outliner.closed, (std::set<std::string>{"Lights", "Objects"}));
    EXPECT_TRUE(state.selection.empty());
    click(0);
    EXPECT_EQ(state.outliner.closed, std::set<std::string>{"Objects"});
    click(1);
    EXPECT_EQ(state.selection, std::vector{idNamed(state, "Sun")});
}

TEST_F(Outliner, AFilterLooksIntoClosedSections) {
    state.outliner.closed = {"Lights", "Objects"};
    state.outliner.filter = "lamp";
    click(1);
    EXPECT_EQ(state.selection, std::vector{idNamed(state, "Lamp")});
}

} // namespace
} // namespace limn::outliner_test
