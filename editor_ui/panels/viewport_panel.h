// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// The mouse in the picture: navigation, picking, the gizmo; icons of lights and outlines drawn
/// over it. Draws into the current window, which shows the picture through; keeps state.view.origin
/// and size.
void viewportPanel(EditorState& state);

} // namespace limn
