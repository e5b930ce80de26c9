// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/panels/keys.h"
#include "editor_ui/view/gizmo_math.h"

namespace limn {

struct EditorState;

/// Where the mouse is in the window [px].
glm::vec2 mousePosition();

/// Draws the gizmo of the selection and the handles of a selected light, and lets the mouse drag
/// them. One drag is one edit. Ctrl snaps, Shift moves a tenth of the way, Alt on a handle drags
/// copies; characters lock an axis or are a number, see typeIntoDrag(). `mouseHere` is true if the
/// mouse is over the picture and free. Returns true if it took this frame's click.
bool useGizmo(EditorState& state, bool mouseHere);

/// Whether the mouse is over a handle, which it would drag.
bool overHandle(const EditorState& state);

/// Lets the selection follow the mouse without a button, until Enter or a click; the right button
/// takes it back, as cancelDrag() does. Does nothing if nothing can be moved.
void grabSelection(EditorState& state, Tool tool);

/// Ends the drag, if any, as though it had never begun.
void cancelDrag(EditorState& state);

/// Offers a key that went down to the drag, if any: Enter ends it, Backspace deletes a digit, and
/// no other key without Ctrl or Alt runs an action. Returns true if it took the key.
bool keyOfDrag(EditorState& state, const Shortcut& pressed);

} // namespace limn
