// SPDX-License-Identifier: MIT
// Someone lights scenes.
#include "engine/files/project_file.h"
#include "tests/core/source_path.h"
#include "tests/journeys/journey.h"

namespace limn {
namespace {

struct LightJourney : Journey {};

TEST_F(LightJourney, ASceneWithoutLightsSaysSoAndIsLitByOneClick) {
    const std::string scene = sourcePath("../shared/scenes/godot-room/room.glb");
    if (lacks(scene))
        return;
    startScreen();
    if (!screen)
        return;
    startEditor(scene);
    ASSERT_TRUE(sees("Nothing lights this scene.", 120));
    settle(20);
    shot("1-hint");
    click("Add sun and sky");
    waitForLight();
    EXPECT_TRUE(seesNoMore("Nothing lights this scene.", 5));
    shot("2-lit");
}

} // namespace
} // namespace limn
