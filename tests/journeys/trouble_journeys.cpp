// SPDX-License-Identifier: MIT
// Someone whose editor ends, whose files are damaged, and whose scenes are large.
#include "editor_ui/jobs/recovery_folder.h"
#include "engine/files/project_file.h"
#include "tests/core/source_path.h"
#include "tests/journeys/journey.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>
#include <thread>
#include <variant>

#include <fmt/format.h>

namespace limn {
namespace {

struct TroubleJourney : Journey {};

/// A court of `count` blocks in a square, as glTF with one mesh. Ends with the file's path.
std::string writeBlocks(const std::filesystem::path& folder, int count) {
    const std::vector<float> corners{-1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1,
                                     -1, 2, -1, 1, 2, -1, 1, 2, 1, -1, 2, 1};
    const std::vector<std::uint16_t> indices{0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6, 0, 4, 5, 0, 5, 1,
                                             1, 5, 6, 1, 6, 2, 2, 6, 7, 2, 7, 3, 3, 7, 4, 3, 4, 0};
    std::ofstream bin(folder / "blocks.bin", std::ios::binary);
    bin.write(reinterpret_cast<const char*>(corners.data()), 96);
    bin.write(reinterpret_cast<const char*>(indices.data()), 72);
    using nlohmann::json;
    json gltf = {
        {"asset", {{"version", "2.0"}}},
        {"buffers", {{{"uri", "blocks.bin"}, {"byteLength", 168}}}},
        {"bufferViews",
         {{{"buffer", 0}, {"byteLength", 96}},
          {{"buffer", 0}, {"byteOffset", 96}, {"byteLength", 72}}}},
        {"accessors",
         {{{"bufferView", 0},
           {"componentType", 5126},
           {"count", 8},
           {"type", "VEC3"},
           {"min", {-1, 0, -1}},
           {"max", {1, 2, 1}}},
          {{"bufferView", 1}, {"componentType", 5123}, {"count", 36}, {"type", "SCALAR"}}}},
        {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
        {"scene", 0}};
    const int side = int(std::ceil(std::sqrt(count)));
    std::mt19937 random(1);
    json nodes = json::array(), roots = json::array();
    for (int i = 0; i < count; ++i) {
        const double height = 0.3 + double(random() % 100) / 100;
        nodes.push_back({{"name", fmt::format("Block {}", i + 1)},
                         {"mesh", 0},
                         {"translation", {3 * (i % side) - 1.5 * side, 0, -3 * (i / side)}},
                         {"scale", {1, height, 1}}});
        roots.push_back(i);
    }
    gltf["nodes"] = nodes;
    gltf["scenes"] = {{{"nodes", roots}}};
    const std::filesystem::path path = folder / "blocks.gltf";
    std::ofstream(path) << gltf;
    return path.string();
}

/// Cornell with `count` small lamps below its ceiling.
Document cornellWithLamps(int count) {
    Document document = loadProject(sourcePath("projects/cornell/cornell.limn"))->document;
    std::mt19937 random(1);
    const auto from = [&](float low, float high) {
        return low + (high - low) * float(random() % 1000) / 1000;
    };
    for (int i = 0; i < count; ++i)
        addObject(document,
                  Light{.name = fmt::format("Lamp {}", i + 1),
                        .position = {from(-0.9f, 0.9f), from(0.1f, 1.8f), from(-0.9f, 0.9f)},
                        .color = {from(0, 1), from(0, 1), from(0, 1)},
                        .strength = 0.01f});
    return document;
}

TEST_F(TroubleJourney, UnsavedWorkOutlivesAKill) {
    startScreen();
    if (!screen)
        return;
    const std::string project = draftCornell();
    startEditor(project);
    waitForLight();
    run("Sun and sky");
    waitForLight();
    shot("1-edited");
    std::this_thread::sleep_for(std::chrono::seconds(5));
    editor->kill();
    startEditor(project);
    ASSERT_TRUE(sees("An editor ended before these changes were saved:", 60));
    settle(20);
    shot("2-offer");
    click("Recover");
    EXPECT_TRUE(sees("Sun", 60, outliner()));
    waitForLight();
    shot("3-recovered");
}

std::size_t lightsOf(const std::string& project) {
    const auto loaded = loadProject(project);
    return loaded
               ? std::size_t(std::ranges::count_if(
                     loaded->document.objects,
                     [](const auto& entry) { return std::holds_alternative<Light>(entry.second); }))
               : 0;
}

/// Prints for each kill how old the oldest edit was that is not in the copy.
TEST_F(TroubleJourney, TwentyKillsAtRandomTimesLoseTheNewestEditsAlone) {
    using Clock = std::chrono::steady_clock;
    std::mt19937 random(1);
    double worst = 0;
    for (int kill = 0; kill < 20; ++kill) {
        if (kill == 0)
            startScreen(800, 600);
        if (!screen)
            return;
        std::filesystem::remove_all(scratch / "limn/recovery");
        startEditor(draftCornell(), {"--no-bake"});
        ASSERT_TRUE(sees("Floor", 120, outliner()));
        run("Sun and sky"); // the newest light is selected; each copy of it is an edit
        ASSERT_TRUE(sees("Sun", 60, outliner()));
        std::vector<Clock::time_point> edits;
        const auto end = Clock::now() + std::chrono::milliseconds(3000 + random() % 7000);
        while (Clock::now() < end) {
            edits.push_back(Clock::now());
            screen->key("ctrl+d");
        }
        const auto killed = Clock::now();
        editor->kill();
        std::size_t kept = 0; // copies of the sun
        if (const auto lost = findRecovery((scratch / "limn/recovery").string(), ""))
            kept = std::max(lightsOf(lost->documentPath()), std::size_t(1)) - 1;
        const double age =
            kept < edits.size() ? std::chrono::duration<double>(killed - edits[kept]).count() : 0;
        worst = std::max(worst, age);
        fmt::print("kill {:2}: {} edits, {} kept, oldest lost one {:.2f} s old\n", kill + 1,
                   edits.size(), kept, age);
        std::fflush(stdout);
    }
    fmt::print("oldest edit lost in 20 kills: {:.2f} s\n", worst);
}

TEST_F(TroubleJourney, ADamagedProjectIsRefusedWhereOneLooks) {
    startScreen();
    if (!screen)
        return;
    std::ifstream in(sourcePath("projects/cornell/cornell.limn"));
    const std::string whole((std::istreambuf_iterator<char>(in)), {});
    std::ofstream(scratch / "damaged.limn") << whole.substr(0, whole.size() / 2);
    startEditor(draftCornell());
    waitForLight();
    screen->key("ctrl+o");
    ASSERT_TRUE(sees("Cancel", 20));
    enterPath((scratch / "damaged.limn").string());
    EXPECT_TRUE(sees("Not opened", 30));
    settle(20);
    shot("1-refused");
    EXPECT_TRUE(sees("Panel", 5, outliner())) << "what was open stays";
    click("Dismiss");
    EXPECT_TRUE(seesNoMore("Not opened", 10));
}

TEST_F(TroubleJourney, FiveHundredLightsAreShownAndOneOfThemIsEdited) {
    startScreen();
    if (!screen)
        return;
    const std::string project = (scratch / "lamps.limn").string();
    ASSERT_TRUE(saveProject(project, cornellWithLamps(500)));
    startEditor(project);
    waitForLight(600);
    shot("1-lamps");
    select("Lamp 250");
    setField("Strength (cd)", {"1"});
    ASSERT_TRUE(waitFor([](const auto& s) { return s["edits"] == 1 && s["relight_converged"]; }));
    waitForLight(300);
    shot("2-one-brighter");
    showTab("Lights");
    EXPECT_TRUE(sees("Lamp 5", 10, {{0, upperHeight()}, {float(width), float(height)}}));
    shot("3-mixer");
}

TEST_F(TroubleJourney, FiveThousandObjectsAreLitSelectedAndMoved) {
    startScreen();
    if (!screen)
        return;
    startEditor(writeBlocks(scratch, 5000));
    ASSERT_TRUE(sees("Nothing lights this scene.", 200));
    click("Add sun and sky");
    waitForLight(600);
    shot("1-lit");
    clickAt(picture().origin + glm::vec2(8)); // the keys are the picture's
    screen->key("ctrl+a");
    ASSERT_TRUE(waitFor([](const auto& s) { return s["selection"].size() > 5000; }));
    settle(30);
    shot("2-all-selected");
    fmt::print("selecting all: {}\n", statistics()["longest_frame_since_idle"].dump());
    screen->key("Escape");
    select("Block 2525");
    screen->key("f");
    settle(60);
    shot("3-one-selected");
    setField("Position (m)", {"0", "3", "0"});
    ASSERT_TRUE(waitFor([](const auto& s) { return s["edits"] == 2; })) << "with the sun's";
    waitForLight(600);
    shot("4-moved");
    fmt::print("longest frame {:.1f} ms\n",
               statistics()["longest_frame"]["beyond_viewport_ms"].get<double>());
}

} // namespace
} // namespace limn
