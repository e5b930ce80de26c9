// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// The menu bar over the whole width; every entry comes from the table of actions.
void menuBar(EditorState& state);

/// Tools, view, tone mapping and exposure above the picture. Draws into the current window.
void viewBar(EditorState& state);

/// One line at the bottom: stage, progress and time left of a running bake with a Cancel button,
/// else the state in words. Draws into the current window.
void statusBar(EditorState& state);

} // namespace limn
