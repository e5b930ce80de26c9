// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// Time per step, counts, bytes, seconds per bake stage. Draws into the current window.
void statisticsPanel(EditorState& state);

/// What was repaired on import and what went wrong since. Draws into the current window.
void logPanel(const EditorState& state);

} // namespace limn
