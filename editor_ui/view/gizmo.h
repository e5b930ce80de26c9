// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// The translate gizmo of the selection: three arrows (X red, Y green, Z blue) and three planes.
/// One drag is one edit; Ctrl snaps to a round step, Shift moves a tenth. `mouseHere` is true if
/// the mouse is over the picture and free.
void moveGizmo(EditorState& state, bool mouseHere);

} // namespace limn
