// SPDX-License-Identifier: MIT
// Someone moves things and takes light elsewhere.
#include "tests/journeys/journey.h"

#include <chrono>
#include <thread>

namespace limn {
namespace {

struct ObjectJourney : Journey {};

TEST_F(ObjectJourney, AColumnIsMovedAndTheMoveIsUndone) {
    startScreen();
    if (!screen)
        return;
    startEditor("atrium");
    waitForLight(500);
    shot("1-atrium");
    clickAt(picture().origin + glm::vec2(0.12f, 0.6f) * picture().size);
    settle(20);
    shot("2-selected");
    screen->key("g");
    screen->key("x");
    screen->type("1.5");
    settle(20);
    shot("3-typing");
    screen->key("Return");
    waitForLight(500);
    EXPECT_EQ(statistics()["edits"], 1);
    shot("4-moved");
    screen->key("ctrl+z");
    waitForLight(500);
    EXPECT_EQ(statistics()["edits"], 0);
    shot("5-undone");
}

TEST_F(ObjectJourney, LightIsExportedAndTheExportIsOpened) {
    startScreen();
    if (!screen)
        return;
    startEditor(draftCornell());
    waitForLight();
    screen->key("ctrl+e");
    ASSERT_TRUE(sees("Format", 20));
    settle(20);
    shot("1-dialog");
    const std::filesystem::path exported = scratch / "room.gltf";
    choose("Format", "glTF with lightmap", exportDialog());
    setField("File", {exported.string()}, exportDialog());
    settle(20);
    shot("2-where-to");
    click("Export", exportDialog());
    for (int i = 0; i < 600 && !std::filesystem::exists(exported); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    settle(20);
    shot("3-written");
    ASSERT_TRUE(std::filesystem::exists(exported));
    click("Close", exportDialog());
    screen->key("ctrl+o");
    ASSERT_TRUE(sees("Cancel", 20));
    enterPath(exported.string());
    EXPECT_TRUE(sees("Save changes?", 10)) << "its settings are an edit";
    click("Don't save");
    EXPECT_TRUE(sees("Short block", 60, outliner()));
    waitForLight();
    shot("4-opened");
}

} // namespace
} // namespace limn
