// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// Draws the header of a card of the inspector, which a click opens and closes. Returns whether the
/// card is open and its rows are to be drawn. Cards of the same title open and close together,
/// whatever is selected.
bool card(EditorState& state, const char* title);

} // namespace limn
