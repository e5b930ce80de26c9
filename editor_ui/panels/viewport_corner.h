// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// Width of the axes with their margins [px]; they are as high as wide.
float axisWidgetWidth();

/// The world's axes as the view sees them, in the upper right of the picture. A click on the end
/// of one looks from there. Returns true while the mouse is over an end, so that the picture does
/// not take the click. `hovered`: nothing lies over the picture under the mouse.
bool axisWidget(EditorState& state, bool hovered);

/// Resolution of the picture, its time, and whether it is still getting better, in the lower right.
void pictureReadout(const EditorState& state);

} // namespace limn
