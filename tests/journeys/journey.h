// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/panels/workspace.h"
#include "tests/app/virtual_screen.h"
#include "tests/editor_ui/headless.h"
#include "tests/journeys/screen_text.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace limn {

/// Someone who uses the editor's window by real mouse and key events and sees only its pixels: each
/// text that is clicked is found on the screen first. Pictures of the screen are left in
/// build/journeys/TEST. Skips itself without Xvfb and xdotool.
struct Journey : testing::Test {
    std::filesystem::path scratch; ///< the user's home, removed at the end
    std::filesystem::path pictures;
    std::optional<VirtualScreen> screen;
    std::optional<ChildProcess> editor;
    std::optional<HeadlessUi> font; ///< by which text is found

    /// A new screen, at `dpi` for the program as for us.
    void startScreen(int width = 1280, int height = 800, int dpi = 96);
    /// Opens a scene in a window as large as the screen, or none.
    void startEditor(const std::string& scene, const std::vector<std::string>& more = {});
    void TearDown() override;

    /// Writes the sample Cornell with the settings of a draft bake; returns the project's path.
    std::string draftCornell() const;

    /// Skips the test and returns true where a scene of others is not there.
    static bool lacks(const std::string& path);

    /// Waits until the text stands on the screen; returns false if it does not within `seconds`.
    bool sees(const std::string& text, double seconds = 60, const ScreenRect& within = {});
    /// Waits until it does not.
    bool seesNoMore(const std::string& text, double seconds = 60);
    /// Waits until the screen does not change for a second, at most `seconds`.
    void settle(double seconds = 60);
    /// Waits for the text and clicks the middle of the first place of it; fails the test if there
    /// is none.
    void click(const std::string& text, const ScreenRect& within = {});
    void clickAt(glm::vec2 pixel) { screen->click(pixel); }
    /// Moves the mouse away, so that no tooltip covers what is read next.
    void rest();
    /// Runs an action by its whole label, as the list of all actions has it (Ctrl-P).
    void run(const std::string& action);
    /// Selects an object by its name, through the filter of the list on the left.
    void select(const std::string& name);
    /// Types into the fields beside a label of a panel, the inspector where it is of size 0.
    void setField(const std::string& label, const std::vector<std::string>& values,
                  const ScreenRect& panel = {});
    /// Opens the list beside a label of such a panel and clicks an entry of it.
    void choose(const std::string& label, const std::string& entry, const ScreenRect& panel = {});
    /// Types a path into the open file dialog and accepts it.
    void enterPath(const std::string& path);
    /// Waits until bake and light are up to date.
    void waitForLight(double seconds = 600);
    /// Writes build/journeys/TEST/NAME.png.
    void shot(const std::string& name);

    /// What --stats-json wrote when the editor was last idle; null: nothing yet.
    nlohmann::json statistics() const;
    bool waitFor(const std::function<bool(const nlohmann::json&)>& condition, double seconds = 300);
    /// Ctrl-Q; expects no unsaved changes and an exit without an error.
    void quit();

    int width = 0, height = 0;
    LayoutState layout; ///< of the window; bottomOpen follows showTab()
    /// Opens a tab of the bottom panel.
    void showTab(const std::string& label);
    /// The parts of the window that no journey resizes by hand.
    ScreenRect outliner() const;
    ScreenRect inspector() const;
    ScreenRect picture() const;
    ScreenRect exportDialog() const;

    float upperHeight() const; ///< down to the bottom panel [px]

private:
    /// Of what stands beside a label, near its left end.
    glm::vec2 fieldAt(const std::string& label, ScreenRect panel);

    int m_dpi = 96;
};

} // namespace limn
