// SPDX-License-Identifier: MIT
// Pictures of every workspace for the eye, at several sizes of the screen, in both themes, with a
// long name and with nothing in the scene.
#include "tests/journeys/journey.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fmt/format.h>

namespace limn {
namespace {

struct WorkspacePictures : Journey {
    void takeAll(const std::string& scene, const std::string& of) {
        for (const char* theme : {"dark", "light"}) {
            for (const char* workspace : {"Light", "Bake", "Inspect", "Compare"}) {
                run(fmt::format("{} workspace", workspace));
                rest();
                settle(8);
                shot(fmt::format("{}-{}-{}", of, workspace, theme));
            }
            run("Light workspace");
            run("Light theme");
        }
        EXPECT_TRUE(editor->running()) << scene;
        std::this_thread::sleep_for(std::chrono::seconds(2)); // the settings are written
    }

    void ofScreen(int screenWidth, int screenHeight, int dpi) {
        const std::string size = fmt::format("{}x{}-{}dpi", screenWidth, screenHeight, dpi);
        startScreen(screenWidth, screenHeight, dpi);
        if (!screen)
            return;
        const std::string named =
            (scratch / "Donaudampfschifffahrtselektriz\u00e4tenhauptbetriebswerkbauunterbeamten"
                       "gesellschaft (Kopie, endg\u00fcltige Fassung, \u00fcberarbeitet).limn")
                .string();
        std::filesystem::rename(draftCornell(), named);
        startEditor(named);
        ASSERT_TRUE(sees("Floor", 120, outliner()));
        select("Tall block");
        takeAll(named, size + "-long-name");
        const std::string empty = (scratch / "leer.gltf").string();
        std::ofstream(empty) << R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{}]})";
        startEditor(empty, {"--no-bake"});
        ASSERT_TRUE(sees("Nothing to bake", 60));
        takeAll(empty, size + "-empty");
    }
};

TEST_F(WorkspacePictures, AtSmallWindows) {
    ofScreen(1280, 720, 96);
}

TEST_F(WorkspacePictures, AtLargeWindows) {
    ofScreen(1920, 1080, 96);
}

TEST_F(WorkspacePictures, AtTwiceTheDensity) {
    ofScreen(2560, 1440, 192);
}

} // namespace
} // namespace limn
