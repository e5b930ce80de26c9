// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// Shows the time per step of light and picture, and that of the window's frames. Draws into the
/// current window.
void profilePanel(EditorState& state);

/// Shows bytes, counts, and seconds per bake stage. Draws into the current window.
void memoryPanel(EditorState& state);

/// Shows what was repaired on import and what has gone wrong since. Draws into the current window.
void logPanel(const EditorState& state);

} // namespace limn
