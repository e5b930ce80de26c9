// SPDX-License-Identifier: MIT
// Someone moves things and takes light elsewhere.
#include "tests/core/source_path.h"
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

TEST_F(ObjectJourney, OneObjectIsInspectedAndBakedAlone) {
    startScreen(1280, 720);
    if (!screen)
        return;
    startEditor(draftCornell());
    waitForLight();
    select("Tall block");
    run("Dependencies");
    EXPECT_TRUE(sees("What lights Tall block", 30));
    screen->move(picture().origin + glm::vec2(0.5f, 0.3f) * picture().size); // the back wall
    EXPECT_TRUE(sees("Receives", 30, picture()));
    settle(20);
    shot("1-dependencies");
    run("Texel density");
    screen->move(picture().origin + glm::vec2(0.7f, 0.8f) * picture().size);
    EXPECT_TRUE(sees("texels per metre", 30, picture()));
    run("Bake the selection only");
    EXPECT_TRUE(sees("only a selection has all of its texels", 60));
    settle(20);
    shot("2-selection-baked");
    run("No overlay");
    run("Wireframe");
    rest();
    settle(20);
    shot("3-wireframe");
    run("Invalid pixels (NaN, Inf)");
    EXPECT_TRUE(sees("are magenta", 30, picture()));
    settle(20);
    shot("4-invalid-pixels");
    run("Invalid pixels (NaN, Inf)");
    run("Squared relative error (relMSE)");
    EXPECT_TRUE(sees("Squared relative error", 300, picture())) << "once there is a reference";
    rest();
    settle(30);
    shot("5-squared-error");
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

TEST_F(ObjectJourney, TimeIsScrubbedAndPlayed) {
    const std::string scene =
        sourcePath("../shared/scenes/features/gdx-gltf/lightCameraAnimations.gltf");
    if (lacks(scene))
        return;
    startScreen();
    if (!screen)
        return;
    startEditor(scene);
    waitForLight();
    const ScreenRect row = {{picture().origin.x, upperHeight() - 20}, {picture().size.x, 50}};
    EXPECT_TRUE(sees("0.00 s", 20, row));
    const Image atRest = screen->picture();
    clickAt(row.origin + glm::vec2(0.7f * row.size.x, 22)); // on the slider
    rest();
    EXPECT_TRUE(seesNoMore("0.00 s", 20));
    waitForLight();
    shot("1-scrubbed");
    EXPECT_FALSE(screen->picture() == atRest);
    click("Play", row);
    rest(); // no tooltip covers the row
    EXPECT_TRUE(sees("Pause", 20, row));
    shot("2-plays");
    click("Pause", row);
    rest();
    EXPECT_TRUE(sees("Play", 20, row));
    click("Start", row);
    rest();
    EXPECT_TRUE(sees("0.00 s", 20, row));
    waitForLight();
    shot("3-at-rest");
}

} // namespace
} // namespace limn
