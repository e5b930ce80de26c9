// SPDX-License-Identifier: MIT
// Starts the editor on a screen without a monitor and uses it with real mouse and key events.
#include "editor_ui/view/gizmo_math.h"
#include "engine/files/image_file.h"
#include "engine/files/project_file.h"
#include "tests/app/virtual_screen.h"
#include "tests/core/source_path.h"
#include "tests/editor_ui/headless.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace limn::editor_window_test {
namespace {

namespace fs = std::filesystem;

/// A window in which everything has its place, and one whose picture is gathered in seconds.
constexpr glm::ivec2 kLarge{1024, 768}, kSmall{640, 480};

/// Cornell with a point light, baked in a second or two.
Document testDocument(ObjectId& light, const TechniqueChoice& technique) {
    Document document = loadProject(sourcePath("projects/cornell/cornell.limn"))->document;
    for (auto& [id, object] : document.objects)
        if (auto* settings = std::get_if<BakeSettings>(&object)) {
            settings->surfels = 512;
            settings->lightmapCaches = 600;
            settings->rays = 64;
            settings->links = 32;
        }
    addObject(document, technique); // which the editor would add, as this:
    addObject(document, RelightSettings{});
    light = addObject(document, Light{.name = "Lamp", .position = {0, 1, 0.3f}, .strength = 0.5f});
    return document;
}

/// Where the editor puts its picture: the same interface, drawn without a window.
Picture pictureOf(const std::string& project, glm::ivec2 window) {
    const ImportedScene opened = *loadProject(project);
    HeadlessUi ui(float(window.x), float(window.y));
    EditorState state;
    state.assets = opened.assets;
    state.document = opened.document;
    state.view.camera = chooseCamera(flatten(opened.document, opened.assets), {});
    ui.frames(state);
    return state.view.picture();
}

struct EditorWindowTest : testing::Test {
    fs::path folder = fs::temp_directory_path() / fmt::format("limn-window-{}", processId());
    std::string project = (folder / "test.limn").string(), stats = (folder / "stats.json").string();
    ObjectId light = 0;
    Document document;
    std::optional<VirtualScreen> screen;
    std::optional<ChildProcess> editor;

    void SetUp() override {
        auto started = startVirtualScreen(kLarge.x, kLarge.y, folder.string());
        if (!started)
            GTEST_SKIP() << "needs Xvfb and xdotool";
        screen.emplace(std::move(*started));
        document = testDocument(light, technique());
        ASSERT_TRUE(saveProject(project, document));
        startEditor();
        document = loadProject(project)->document;
    }

    void startEditor() {
        editor.emplace(std::vector<std::string>{LIMN_BINARY, "edit", project, "--size",
                                                fmt::format("{}x{}", window().x, window().y),
                                                "--stats-json", stats, "--validate", "--relight",
                                                relightOn()},
                       screen->environment(), folder.string());
    }

    virtual std::string relightOn() const { return "auto"; }
    virtual TechniqueChoice technique() const { return {}; }
    virtual glm::ivec2 window() const { return kLarge; }
    Picture picture() const { return pictureOf(project, window()); }

    void TearDown() override {
        editor.reset();
        screen.reset();
        std::error_code error;
        fs::remove_all(folder, error);
    }

    nlohmann::json readStats() const {
        std::ifstream in(stats);
        return in ? nlohmann::json::parse(in, nullptr, false) : nlohmann::json();
    }

    /// Waits until the statistics fulfil `condition`; they are written whenever the editor has
    /// nothing to do.
    bool waitFor(const std::function<bool(const nlohmann::json&)>& condition) {
        for (int i = 0; i < 1800; ++i) {
            if (const auto json = readStats(); json.is_object() && condition(json))
                return true;
            if (!editor->running())
                return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        return false;
    }

    glm::vec3 savedPosition() const {
        return std::get<Light>(loadProject(project)->document.objects.at(light)).position;
    }
};

TEST_F(EditorWindowTest, ALightIsPickedDraggedSavedUndoneAndLitWithoutABake) {
    ASSERT_TRUE(
        waitFor([](const auto& s) { return s["bake_up_to_date"] && s["relight_converged"]; }));
    const Picture shown = picture();
    const glm::vec3 origin = std::get<Light>(document.objects.at(light)).position;
    const float length = arrowLength(shown, origin);
    const glm::vec2 icon = *toPixel(shown, origin);

    screen->focusWindow();
    screen->click(icon);
    ASSERT_TRUE(waitFor([&](const auto& s) { return s["selection"] == nlohmann::json{light}; }));

    screen->drag(*toPixel(shown, arrowTip(Handle::X, {origin}, 0.8f * length)),
                 *toPixel(shown, arrowTip(Handle::X, {origin}, 1.6f * length)));
    ASSERT_TRUE(waitFor([](const auto& s) { return s["edits"] == 1 && s["relight_converged"]; }));
    EXPECT_EQ(readStats()["bake_seconds_since_light_edit"], 0);
    screen->key("ctrl+s");
    ASSERT_TRUE(waitFor([](const auto& s) { return s["unsaved"] == false; }));
    const glm::vec3 moved = savedPosition() - origin;
    EXPECT_NEAR(moved.x, 0.8f * length, 0.03f * length); // the mouse stands on whole pixels
    EXPECT_EQ(moved.y, 0);
    EXPECT_EQ(moved.z, 0);

    screen->key("ctrl+z");
    ASSERT_TRUE(waitFor([](const auto& s) { return s["edits"] == 0 && s["unsaved"] == true; }));
    screen->key("ctrl+s");
    ASSERT_TRUE(waitFor([](const auto& s) { return s["unsaved"] == false; }));
    EXPECT_EQ(loadProject(project)->document.objects, document.objects);

    EXPECT_GT(screen->colorsIn(shown.origin, shown.size), 200u); // the picture is drawn
    EXPECT_GT(screen->colorsIn({0, 0}, {float(kLarge.x), shown.origin.y}), 10u); // and the menu
    screen->key("F12");
    ASSERT_TRUE(waitFor([&](const auto&) { return fs::exists(folder / "limn-1.png"); }));

    screen->key("ctrl+q");
    EXPECT_EQ(editor->wait(), 0);
    const auto last = readStats();
    EXPECT_EQ(last["validation_messages"], nlohmann::json::array());
    EXPECT_EQ(last["bake_seconds_since_light_edit"], 0);
    const Result<Image> shot = readPng((folder / "limn-1.png").string());
    ASSERT_TRUE(shot);
    EXPECT_EQ(shot->width, unsigned(shown.size.x));
}

TEST_F(EditorWindowTest, AnEditOutlivesAKillAndIsOfferedAtTheNextStart) {
    ASSERT_TRUE(waitFor([](const auto& s) { return s["bake_up_to_date"] == true; }));
    screen->focusWindow();
    screen->click(*toPixel(picture(), std::get<Light>(document.objects.at(light)).position));
    ASSERT_TRUE(waitFor([&](const auto& s) { return s["selection"] == nlohmann::json{light}; }));
    screen->key("Delete");
    ASSERT_TRUE(waitFor([](const auto& s) { return s["edits"] == 1; }));
    std::this_thread::sleep_for(std::chrono::seconds(5)); // nothing older may be lost
    editor->kill();
    EXPECT_TRUE(loadProject(project)->document.objects.contains(light)) << "the user's file";

    fs::remove(stats);
    startEditor();
    ASSERT_TRUE(waitFor([](const auto& s) { return s["bake_up_to_date"] == true; }));
    EXPECT_EQ(readStats()["unsaved"], false);
    screen->focusWindow();
    screen->key("Return");
    ASSERT_TRUE(waitFor([](const auto& s) { return s["unsaved"] == true; }));
    screen->key("ctrl+s");
    ASSERT_TRUE(waitFor([](const auto& s) { return s["unsaved"] == false; }));
    EXPECT_FALSE(loadProject(project)->document.objects.contains(light));
    screen->key("ctrl+q");
    EXPECT_EQ(editor->wait(), 0);
    EXPECT_TRUE(fs::is_empty(folder / "limn/recovery"));
}

TEST_F(EditorWindowTest, AnIdleEditorDrawsNothingOnceItKnowsWhichDeviceRelightsFaster) {
    ASSERT_TRUE(waitFor([](const auto& s) {
        return s["bake_up_to_date"] && s["relight_converged"] && s["relight_gpu_ms"] > 0;
    }));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const auto before = readStats();
    EXPECT_GT(before["relight_cpu_ms"], 0);
    EXPECT_EQ(before["relight_on"],
              before["relight_gpu_ms"] < before["relight_cpu_ms"] ? "gpu" : "cpu");
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    screen->focusWindow();
    screen->key("ctrl+q");
    EXPECT_EQ(editor->wait(), 0);
    EXPECT_LE(readStats()["frames"].get<std::uint64_t>(),
              before["frames"].get<std::uint64_t>() + 20); // those of the key itself

    // A picture follows what the editor has measured.
    const fs::path remembered = folder / "limn/relight.json";
    std::ifstream in(remembered);
    nlohmann::json times = nlohmann::json::parse(in);
    for (auto& [key, row] : times["times"].items())
        for (const bool gpu : {false, true}) {
            row["gpu_ms"] = row["cpu_ms"].get<double>() * (gpu ? 0.5 : 2);
            std::ofstream(remembered) << times;
            const std::string out = (folder / "render.json").string();
            ASSERT_EQ(std::system(fmt::format("XDG_CACHE_HOME='{}' '{}' render '{}' --json -o '{}' "
                                              "--width 32 --height 32 >'{}' 2>'{}.err'",
                                              folder.string(), LIMN_BINARY, project,
                                              (folder / "small.png").string(), out, out)
                                      .c_str()),
                      0);
            std::ifstream printed(out);
            const nlohmann::json rendered = nlohmann::json::parse(printed);
            EXPECT_EQ(rendered["relight"]["device"] == "cpu", !gpu) << key;
        }
}

struct EditorInASmallWindowTest : EditorWindowTest {
    glm::ivec2 window() const override { return kSmall; }
};

TEST_F(EditorInASmallWindowTest, AFocusedTextFieldDrawsNothing) {
    ASSERT_TRUE(waitFor([](const auto& s) {
        return s["bake_up_to_date"] && s["relight_converged"] && s["relight_gpu_ms"] > 0 &&
               s["gathered"] == 1;
    }));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const std::uint64_t before = readStats()["frames"];
    screen->focusWindow();
    screen->key("ctrl+p"); // its field has the focus
    ASSERT_TRUE(waitFor([&](const auto& s) { return s["frames"] > before; }));
    std::uint64_t opened = 0; // frames, when they rest for the first time
    for (int i = 0; i < 20 && opened != readStats()["frames"]; ++i) {
        opened = readStats()["frames"];
        std::this_thread::sleep_for(std::chrono::seconds(1));
    }
    std::this_thread::sleep_for(std::chrono::seconds(4)); // a cursor that blinks is drawn six times
    EXPECT_EQ(readStats()["frames"], opened);
    screen->key("Escape");
    screen->key("ctrl+q");
    EXPECT_EQ(editor->wait(), 0);
}

struct EditorOnGpuTest : EditorInASmallWindowTest {
    std::string relightOn() const override { return "gpu"; }

    /// Selects the light, drags it along X and waits until its light has converged.
    void dragTheLight() {
        const std::uint64_t calls = readStats()["relight_calls"];
        const Picture shown = picture();
        const glm::vec3 origin = std::get<Light>(document.objects.at(light)).position;
        const float length = arrowLength(shown, origin);
        screen->focusWindow();
        screen->click(*toPixel(shown, origin));
        ASSERT_TRUE(
            waitFor([&](const auto& s) { return s["selection"] == nlohmann::json{light}; }));
        EXPECT_EQ(readStats()["relight_calls"], calls) << "nothing that gives light has changed";
        screen->drag(*toPixel(shown, arrowTip(Handle::X, {origin}, 0.8f * length)),
                     *toPixel(shown, arrowTip(Handle::X, {origin}, 1.6f * length)));
        ASSERT_TRUE(waitFor([&](const auto& s) {
            return s["edits"] == 1 && s["relight_converged"] && s["relight_calls"] > calls;
        }));
        EXPECT_GT(screen->colorsIn(shown.origin, shown.size), 200u);
    }

    /// Expects that nothing is done any more.
    nlohmann::json statsOfASleeper() {
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        const auto before = readStats();
        std::this_thread::sleep_for(std::chrono::milliseconds(1500));
        EXPECT_EQ(readStats(), before) << "it sleeps";
        return before;
    }

    void saveAndQuit() {
        screen->focusWindow();
        screen->key("ctrl+s");
        ASSERT_TRUE(waitFor([](const auto& s) { return s["unsaved"] == false; }));
        screen->key("ctrl+q");
        EXPECT_EQ(editor->wait(), 0);
        EXPECT_EQ(readStats()["validation_messages"], nlohmann::json::array());
    }
};

TEST_F(EditorOnGpuTest, AMovedLightIsFollowedUntilItConvergesAndThenNothingIsDrawn) {
    ASSERT_TRUE(
        waitFor([](const auto& s) { return s["bake_up_to_date"] && s["relight_converged"]; }));
    EXPECT_EQ(readStats()["relight_on"], "gpu");
    EXPECT_GT(readStats()["relight_calls"], 1U) << "a few bounces at a time";
    ASSERT_NO_FATAL_FAILURE(dragTheLight());
    ASSERT_TRUE(waitFor([](const auto& s) { return s["gathered"] == 1; }));
    const nlohmann::json before = statsOfASleeper();
    ASSERT_NO_FATAL_FAILURE(saveAndQuit());
    const auto last = readStats();
    EXPECT_EQ(last["bake_seconds_since_light_edit"], 0);
    EXPECT_EQ(last["relight_calls"], before["relight_calls"]);
}

struct EditorLpvOnGpuTest : EditorOnGpuTest {
    TechniqueChoice technique() const override { return {"lpv", {}}; }
};

struct EditorProbesOnGpuTest : EditorOnGpuTest {
    TechniqueChoice technique() const override { return {"probes", {}}; }
};

/// Drags the light in an editor whose technique needs no bake.
void expectLightWithoutABake(EditorOnGpuTest& test) {
    ASSERT_TRUE(test.waitFor([](const auto& s) {
        return s["relight_on"] == "gpu" && s["relight_converged"] && s["relight_calls"] > 0;
    }));
    ASSERT_NO_FATAL_FAILURE(test.dragTheLight());
    EXPECT_EQ(test.statsOfASleeper()["bake_seconds"], 0);
    ASSERT_NO_FATAL_FAILURE(test.saveAndQuit());
}

TEST_F(EditorLpvOnGpuTest, AMovedLightIsFollowedWithoutABake) {
    expectLightWithoutABake(*this);
}

TEST_F(EditorProbesOnGpuTest, AMovedLightIsFollowedWithoutABake) {
    expectLightWithoutABake(*this);
}

} // namespace
} // namespace limn::editor_window_test
