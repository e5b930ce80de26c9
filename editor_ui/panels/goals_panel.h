// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// The list of places that are to have some light, and the button that solves for the strengths of
/// lights. Draws into the current window.
void goalsPanel(EditorState& state);

/// Numbers of the goals at their places in the picture. Draws into the current window.
void goalMarks(const EditorState& state);

} // namespace limn
