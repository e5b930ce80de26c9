// SPDX-License-Identifier: MIT
// Pictures of the window for docs/gallery.sh.
#include "tests/journeys/journey.h"

namespace limn {
namespace {

struct Gallery : Journey {};

TEST_F(Gallery, GalleryOfWindows) {
    startScreen(1280, 720);
    if (!screen)
        return;
    startEditor("atrium");
    waitForLight();
    rest();
    settle(60);
    shot("editor");
    quit();

    startScreen(1280, 720);
    startEditor(draftCornell());
    waitForLight();
    showTab("Explain");
    clickAt(picture().origin + glm::vec2(0.723f, 0.86f) * picture().size); // the floor at the wall
    ASSERT_TRUE(sees("Red, green, blue", 60));
    click("By sender");
    ASSERT_TRUE(sees("Right wall (Green)", 30));
    rest();
    settle(30);
    shot("explain");
    run("Path-traced reference beside it");
    constexpr unsigned kSamples = 64;
    EXPECT_TRUE(waitFor(
        [](const nlohmann::json& s) {
            return !s["comparison"].is_null() && s["comparison"]["samples"] >= kSamples;
        },
        300));
    rest();
    settle(30);
    shot("compare");
}

} // namespace
} // namespace limn
