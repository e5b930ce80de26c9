// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// The technique that lights the scene, to switch it (one undo step), and the one that is shown
/// beside it, `width` pixels wide. Draws into the current window.
void techniqueCombo(EditorState& state, float width);

} // namespace limn
