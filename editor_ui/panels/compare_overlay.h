// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// Moves the line between Limn's picture and the reference with the mouse, which is over the
/// picture if `hovered`. Returns true if the mouse is on the line or holds it.
bool compareHandle(EditorState& state, bool hovered);

/// Draws the line, names both sides, and tells the reference's noise and the picture's error. Draws
/// into the current window; nothing while nothing is compared.
void compareOverlay(const EditorState& state);

} // namespace limn
