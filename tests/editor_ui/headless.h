// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/editor.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/view/input_queue.h"

namespace limn {

/// ImGui without a window or a GPU, for as long as it lives. One at a time.
struct HeadlessUi {
    InputQueue input;

    /// `scale`: of fonts and spacing, as on a screen of that many times 96 dpi.
    HeadlessUi(float width = 1280, float height = 800, float scale = 1);
    ~HeadlessUi();
    HeadlessUi(const HeadlessUi&) = delete;
    HeadlessUi& operator=(const HeadlessUi&) = delete;

    /// Draws frames until the queue is empty, at least one.
    void frames(EditorState& state);

    void mouse(float x, float y);
    void button(bool down, int which = 0);
    void tap(int key, std::uint8_t mods = kNoMods);
};

/// An editor with nothing open.
EditorState emptyEditor();

/// A group with two boxes below it, lights of every kind, two materials, a camera, sky and bake
/// settings.
EditorState fullEditor();

/// Ids in fullEditor().
ObjectId idNamed(const EditorState& state, const char* name);

} // namespace limn
