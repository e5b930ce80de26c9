// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// Handles the mouse in the picture (navigation, picking, the gizmo) and draws icons of lights and
/// outlines over it. Draws into the current window, through which the picture is visible. Updates
/// state.view.origin and size.
void viewportPanel(EditorState& state);

} // namespace limn
