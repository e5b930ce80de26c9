// SPDX-License-Identifier: MIT
#include "editor_ui/panels/color_field.h"

#include "tests/editor_ui/headless.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <imgui_internal.h>

namespace limn::color_field_test {
namespace {

TEST(ColorField, DisplaysWhatTheSrgbStandardSays) {
    // IEC 61966-2-1: linear 0.2140 is encoded as 0.5; linear 0.0031308 ends the straight part.
    EXPECT_NEAR(displayedColor(glm::vec3(0.21404f)).x, 0.5f, 1e-4);
    EXPECT_NEAR(displayedColor(glm::vec3(0.002f)).x, 12.92f * 0.002f, 1e-6);
    EXPECT_EQ(displayedColor({0, 0, 0}), glm::vec3(0));
    EXPECT_NEAR(displayedColor({1, 1, 1}).x, 1, 1e-6);
    EXPECT_NEAR(displayedColor({4, 0.85616f, 0}).y, 0.5f, 1e-4) << "brighter than the screen";
}

TEST(ColorField, EveryCodeIsReadBackAsItWasTyped) {
    for (int code = 0; code < 256; ++code) {
        const glm::vec3 typed(float(code) / 255, 1, float(255 - code) / 255);
        const glm::vec3 back = displayedColor(linearOfDisplayed(typed, glm::vec3(0)));
        for (int c = 0; c < 3; ++c)
            EXPECT_EQ(std::lround(back[c] * 255), std::lround(typed[c] * 255)) << code;
    }
    const glm::vec3 bright = linearOfDisplayed({1, 0.5f, 0}, {8, 2, 1});
    EXPECT_NEAR(bright.x, 8, 1e-5);
    EXPECT_NEAR(bright.y, 8 * 0.21404f, 1e-3);
}

/// The widget alone in a window.
struct Field : testing::Test {
    HeadlessUi ui;
    glm::vec3 color{0.21404f, 0.5f, 1};
    ImRect swatch;

    void frames() {
        do {
            feedInput(ui.input);
            ImGui::NewFrame();
            ImGui::SetNextWindowPos({0, 0});
            ImGui::SetNextWindowSize({400, 100});
            ImGui::Begin("field");
            ImGui::SetNextItemWidth(300);
            colorField("##color", color);
            swatch = {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
            ImGui::End();
            ImGui::Render();
        } while (!ui.input.events.empty());
    }
    void click(float x, float y) {
        ui.mouse(x, y);
        ui.button(true);
        ui.button(false);
        frames();
        frames();
    }
    ImGuiWindow* picker() const {
        return ImGui::GetCurrentContext()->OpenPopupStack.Size > 0
                   ? ImGui::GetCurrentContext()->OpenPopupStack[0].Window
                   : nullptr;
    }
};

TEST_F(Field, LooksOnAndOpeningThePickerLeaveTheColourAsItIs) {
    const glm::vec3 before = color;
    frames();
    click(swatch.Max.x - 8, (swatch.Min.y + swatch.Max.y) / 2);
    ASSERT_TRUE(picker());
    frames();
    EXPECT_EQ(color, before);
}

TEST_F(Field, ATypedCodeIsAnSrgbColour) {
    frames();
    click(swatch.Max.x - 8, (swatch.Min.y + swatch.Max.y) / 2);
    ASSERT_TRUE(picker());
    const ImRect popup = picker()->Rect();
    click(popup.Min.x + 60, popup.Max.y - 20); // the code is the last row
    ui.tap(key::of('A'), kCtrl);
    ui.tap(key::kLeftControl); // released: characters typed with it are commands
    for (const char c : std::string("#BC4080"))
        ui.input.events.push_back({.kind = InputEvent::Kind::Character, .code = c});
    frames();
    ui.tap(key::kEnter);
    frames();
    const glm::vec3 shown = displayedColor(color);
    EXPECT_EQ(std::lround(shown.x * 255), 0xBC);
    EXPECT_EQ(std::lround(shown.y * 255), 0x40);
    EXPECT_EQ(std::lround(shown.z * 255), 0x80);
    EXPECT_NEAR(color.x, 0.5029f, 1e-3); // ((188/255 + 0.055) / 1.055)^2.4
}

} // namespace
} // namespace limn::color_field_test
