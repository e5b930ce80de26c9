// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// A plot of EditorState::errors: nRMSE and its noise over the seconds since the last edit. Draws
/// into the current window.
void errorPanel(EditorState& state);

} // namespace limn
