// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// Shows time per step, counts, bytes, and seconds per bake stage. Draws into the current window.
void statisticsPanel(EditorState& state);

/// Shows what was repaired on import and what has gone wrong since. Draws into the current window.
void logPanel(const EditorState& state);

} // namespace limn
