// SPDX-License-Identifier: MIT
// How long the window keeps someone waiting while it works.
#include "tests/core/source_path.h"
#include "tests/journeys/journey.h"

#include <filesystem>

#include <fmt/format.h>

namespace limn {
namespace {

struct ResponseJourney : Journey {
    /// Opens `first` and then `sample`, explains a pixel, traces the reference, saves, and prints
    /// the longest frame of each [ms]: for `first` those of a driver that compiles its shaders for
    /// the first pictures. Times of a machine are no reason to fail.
    void printLongestFrames(const std::string& sample, const std::string& first) {
        startScreen();
        if (!screen)
            return;
        startEditor(first);
        waitForLight();
        print("first pictures, " + first, {"open", "bake"});
        screen->key("ctrl+o");
        ASSERT_TRUE(sees("Cancel", 20));
        enterPath(sourcePath("projects/" + sample + "/" + sample + ".limn"));
        ASSERT_TRUE(seesNoMore("Bake up to date", 60));
        waitForLight();
        showTab("Explain");
        clickAt(picture().origin + 0.6f * picture().size);
        ASSERT_TRUE(sees("Red, green, blue", 120));
        screen->key("shift+r");
        ASSERT_TRUE(waitFor([](const auto& s) {
            return !s["comparison"].is_null() && s["comparison"]["samples"] >= 16;
        }));
        screen->key("shift+r");
        screen->key("ctrl+shift+s");
        ASSERT_TRUE(sees("Save as", 20));
        const std::filesystem::path saved = scratch / "saved.limn";
        enterPath(saved.string());
        ASSERT_TRUE(waitFor(
            [&](const auto& s) { return std::filesystem::exists(saved) && took(s, "save") > 0; }));
        showTab("Profile");
        shot(sample);
        print(sample, {"open", "bake", "relight", "explain", "reference", "save"});
    }

private:
    void print(const std::string& when, std::initializer_list<const char*> works) const {
        const nlohmann::json now = statistics();
        for (const char* work : works) {
            EXPECT_GT(took(now, work), 0) << work;
            fmt::print("{}, {}: {}\n", when, work, now["longest_frame_during"][work].dump());
        }
    }

    static double took(const nlohmann::json& statistics, const std::string& work) {
        return statistics["longest_frame_during"][work]["beyond_viewport_ms"];
    }
};

TEST_F(ResponseJourney, TheLongestFramesOfCornellAreToldByWork) {
    printLongestFrames("cornell", "atrium");
}

TEST_F(ResponseJourney, TheLongestFramesOfTheAtriumAreToldByWork) {
    printLongestFrames("atrium", "cornell");
}

} // namespace
} // namespace limn
