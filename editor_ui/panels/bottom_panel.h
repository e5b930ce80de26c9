// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// Height of the bottom panel while it is closed: its tabs alone [px].
float closedBottomHeight();

/// The tabs below the picture and, where LayoutState::bottomOpen, what the chosen one shows. A
/// click on a tab opens it; on the open one, closes it. Draws into the current window.
void bottomPanel(EditorState& state);

} // namespace limn
