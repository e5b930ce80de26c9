// SPDX-License-Identifier: MIT
#include "tests/journeys/journey.h"

#include "editor_ui/editor_state.h"
#include "engine/files/image_file.h"
#include "engine/files/project_file.h"
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
        sleepFor(0.4);
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

std::string Journey::draftCornell() const {
    Document document = loadProject(sourcePath("projects/cornell/cornell.limn"))->document;
    for (auto& [id, object] : document.objects)
        if (auto* settings = std::get_if<BakeSettings>(&object))
            kBakePresets[0].applyTo(*settings);
    const std::string path = (scratch / "room.limn").string();
    EXPECT_TRUE(saveProject(path, document));
    return path;
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
        return equal >= 3;
    });
}

/// Where the text stands as a whole label.
static std::vector<ScreenRect> labels(const Image& screen, const std::string& text,
                                      const ScreenRect& where) {
    std::vector<ScreenRect> found = findText(screen, text, where);
    std::erase_if(found, [&](const ScreenRect& r) { return !endsThere(screen, r); });
    return found;
}

void Journey::click(const std::string& text, const ScreenRect& where) {
    if (!sees(text, 60, where)) {
        shot("lacks " + text);
        FAIL() << "the screen shows no \"" << text << "\"";
    }
    const Image shown = screen->picture();
    std::vector<ScreenRect> found = labels(shown, text, where);
    if (found.empty())
        found = findText(shown, text, where);
    if (!found.empty())
        clickAt(found.front().middle());
}

void Journey::rest() {
    // The right end of the status bar, where nothing stands.
    screen->move({float(width) - 20, float(height) - 12});
    sleepFor(0.3);
}

void Journey::run(const std::string& action) {
    bool open = false;
    for (int i = 0; i < 3 && !open; ++i) { // the window may not have had the focus yet
        screen->focusWindow();
        screen->key("ctrl+p");
        open = sees("New from scene", 20); // the first action; a cursor covers part of the hint
    }
    ASSERT_TRUE(open);
    screen->type(action);
    sleepFor(0.3);
    screen->key("Return");
    sleepFor(0.3);
}

float Journey::upperHeight() const {
    const float scale = float(m_dpi) / 96, tabs = 45; // the status bar is as high
    return float(height) - (tabs + (layout.bottomOpen ? layout.bottom : tabs)) * scale;
}

void Journey::showTab(const std::string& label) {
    const float scale = float(m_dpi) / 96, top = upperHeight();
    const bool found = sees(label, 60, {{0, top - 10 * scale}, {600 * scale, 60 * scale}});
    ASSERT_TRUE(found) << "no tab " << label;
    click(label, {{0, top - 10 * scale}, {600 * scale, 60 * scale}});
    layout.bottomOpen = true;
    settle(10);
}

ScreenRect Journey::outliner() const {
    return {{0, 0}, {layout.left * float(m_dpi) / 96, upperHeight()}};
}

ScreenRect Journey::inspector() const {
    const float wide = layout.right * float(m_dpi) / 96;
    return {{float(width) - wide, 0}, {wide, upperHeight()}};
}

ScreenRect Journey::picture() const {
    const float scale = float(m_dpi) / 96, left = outliner().size.x + 5 * scale;
    const float top = 58 * scale; // menu and view bar
    return {{left, top}, {inspector().origin.x - left - 5 * scale, upperHeight() - top}};
}

void Journey::select(const std::string& name) {
    const float scale = float(m_dpi) / 96;
    const glm::vec2 filter(100 * scale, 42 * scale);
    clickAt(filter);
    screen->key("ctrl+a");
    screen->type(name);
    settle(20); // the list is shown anew with each letter
    const ScreenRect rows{{0, 56 * scale}, outliner().size - glm::vec2(0, 56 * scale)};
    click(name, rows);
    clickAt(filter);
    screen->key("ctrl+a");
    screen->key("Delete");
    screen->key("Return");
    sleepFor(0.3);
}

ScreenRect Journey::exportDialog() const {
    const float wide = 510 * float(m_dpi) / 96;
    return {{(float(width) - wide) / 2, 0}, {wide, float(height)}};
}

glm::vec2 Journey::fieldAt(const std::string& label, ScreenRect panel) {
    if (panel.size.x <= 0)
        panel = inspector();
    std::vector<ScreenRect> found;
    if (!limn::within(20, [&] {
            found = labels(screen->picture(), label, panel);
            return !found.empty();
        })) {
        ADD_FAILURE() << "the panel shows no \"" << label << "\"";
        return {};
    }
    return {panel.origin.x + 0.47f * panel.size.x, found.front().middle().y};
}

void Journey::setField(const std::string& label, const std::vector<std::string>& values,
                       const ScreenRect& panel) {
    screen->clickWith("ctrl", fieldAt(label, panel));
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i > 0)
            screen->key("Tab");
        screen->key("ctrl+a");
        screen->type(values[i]);
    }
    screen->key("Return");
    rest();
}

void Journey::choose(const std::string& label, const std::string& entry, const ScreenRect& panel) {
    const glm::vec2 field = fieldAt(label, panel);
    clickAt(field);
    sleepFor(1);
    // The entries stand below or above the field, which may show the same words.
    std::vector<ScreenRect> found = labels(screen->picture(), entry, {});
    std::erase_if(found, [&](const ScreenRect& r) {
        return r.origin.x < field.x - 40 || std::abs(r.middle().y - field.y) < 8;
    });
    if (found.empty()) {
        ADD_FAILURE() << "no entry \"" << entry << "\" beside " << label;
        shot("lacks " + entry);
        return;
    }
    clickAt(found.front().middle());
    rest();
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
    const float status = 45 * float(m_dpi) / 96;
    EXPECT_TRUE(
        sees("Bake up to date", seconds, {{0, float(height) - status}, {float(width), status}}));
    // Without a picture the window stands still, too.
    EXPECT_TRUE(waitFor([](const auto& s) { return s["pictures"] > 0; }, seconds));
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
