// SPDX-License-Identifier: MIT
#include "tests/journeys/journey.h"

#include "editor_ui/editor_state.h"
#include "engine/files/image_file.h"
#include "tests/core/source_path.h"

#include <chrono>
#include <fstream>
#include <thread>

#include <fmt/format.h>

namespace limn {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

static void sleepFor(double seconds) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// Asks until `done` returns true or the time is over.
static bool within(double seconds, const std::function<bool()>& done) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    do {
        if (done())
            return true;
        sleepFor(0.2);
    } while (Clock::now() < end);
    return done();
}

void Journey::startScreen(int screenWidth, int screenHeight, int dpi) {
    editor.reset();
    screen.reset();
    font.reset();
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    scratch = fs::temp_directory_path() / fmt::format("limn-journey-{}", processId());
    pictures = sourcePath("build/journeys/" + test);
    fs::create_directories(pictures);
    width = screenWidth, height = screenHeight, m_dpi = dpi;
    auto started = startVirtualScreen(width, height, scratch.string());
    if (!started)
        GTEST_SKIP() << "needs Xvfb and xdotool";
    screen.emplace(std::move(*started));
    if (dpi != 96)
        ChildProcess({"xprop", "-root", "-f", "RESOURCE_MANAGER", "8s", "-set", "RESOURCE_MANAGER",
                      fmt::format("Xft.dpi:\t{}\n", dpi)},
                     screen->environment(), scratch.string())
            .wait();
    font.emplace(float(width), float(height), float(dpi) / 96);
    EditorState empty = emptyEditor();
    font->frames(empty); // the atlas is complete
}

void Journey::startEditor(const std::string& scene, const std::vector<std::string>& more) {
    fs::remove(scratch / "stats.json");
    std::vector<std::string> command{LIMN_BINARY,    "edit",
                                     "--size",       fmt::format("{}x{}", width, height),
                                     "--stats-json", (scratch / "stats.json").string()};
    if (!scene.empty())
        command.insert(command.begin() + 2, scene);
    command.insert(command.end(), more.begin(), more.end());
    std::vector<std::string> environment = screen->environment();
    environment.push_back("HOME=" + scratch.string());
    editor.emplace(command, environment, scratch.string());
    screen->focusWindow();
}

void Journey::TearDown() {
    if (HasFailure() && screen && editor)
        shot("failed");
    editor.reset();
    screen.reset();
    std::error_code error;
    fs::remove_all(scratch, error);
}

bool Journey::lacks(const std::string& path) {
    if (fs::exists(path))
        return false;
    [&] { GTEST_SKIP() << "needs " << path; }();
    return true;
}

bool Journey::sees(const std::string& text, double seconds, const ScreenRect& where) {
    return limn::within(seconds,
                        [&] {
                            return !editor->running() ||
                                   !findText(screen->picture(), text, where).empty();
                        }) &&
           editor->running();
}

bool Journey::seesNoMore(const std::string& text, double seconds) {
    return limn::within(seconds, [&] { return findText(screen->picture(), text).empty(); });
}

void Journey::settle(double seconds) {
    Image before = screen->picture();
    int equal = 0;
    limn::within(seconds, [&] {
        Image now = screen->picture();
        equal = now == before ? equal + 1 : 0;
        before = std::move(now);
        return equal >= 5;
    });
}

void Journey::click(const std::string& text, const ScreenRect& where) {
    if (!sees(text, 60, where)) {
        shot("lacks " + text);
        FAIL() << "the screen shows no \"" << text << "\"";
    }
    clickAt(findText(screen->picture(), text, where).front().middle());
}

void Journey::run(const std::string& action) {
    screen->key("ctrl+p");
    ASSERT_TRUE(sees("Type to find an action", 20));
    screen->type(action);
    sleepFor(0.3);
    screen->key("Return");
    sleepFor(0.3);
}

ScreenRect Journey::outliner() const {
    const LayoutState layout;
    const float scale = float(m_dpi) / 96;
    return {{0, 0}, {layout.left * scale, float(height) - layout.bottom * scale}};
}

ScreenRect Journey::inspector() const {
    const LayoutState layout;
    const float scale = float(m_dpi) / 96;
    return {{float(width) - layout.right * scale, 0},
            {layout.right * scale, float(height) - layout.bottom * scale}};
}

void Journey::setField(const std::string& label, const std::string& value) {
    ASSERT_TRUE(sees(label, 20, inspector())) << label;
    const ScreenRect at = findText(screen->picture(), label, inspector()).front();
    const glm::vec2 field(float(width) - 0.25f * inspector().size.x, at.middle().y);
    screen->move(field);
    screen->clickWith("ctrl", field);
    screen->key("ctrl+a");
    screen->type(value);
    screen->key("Return");
    sleepFor(0.3);
}

void Journey::enterPath(const std::string& path) {
    const glm::vec2 button = findText(screen->picture(), "Cancel").back().middle();
    const float row = 25 * float(m_dpi) / 96; // the error's line and half of two frames
    clickAt({float(width) / 2, button.y - 2.2f * row});
    screen->key("ctrl+a");
    screen->type(path);
    sleepFor(0.3);
    screen->key("Return");
    sleepFor(0.5);
}

void Journey::waitForLight(double seconds) {
    EXPECT_TRUE(sees("Bake up to date", seconds));
    settle();
}

void Journey::shot(const std::string& name) {
    Image image = screen->picture();
    EXPECT_TRUE(writePng((pictures / (name + ".png")).string(), image));
}

nlohmann::json Journey::statistics() const {
    std::ifstream in(scratch / "stats.json");
    return in ? nlohmann::json::parse(in, nullptr, false) : nlohmann::json();
}

bool Journey::waitFor(const std::function<bool(const nlohmann::json&)>& condition, double seconds) {
    return limn::within(seconds, [&] {
        const nlohmann::json now = statistics();
        return now.is_object() && condition(now);
    });
}

void Journey::quit() {
    screen->key("ctrl+q");
    EXPECT_EQ(editor->wait(), 0);
}

} // namespace limn
