// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// The table of all lights and the sky: on, solo, colour, strength, and the share of each at the
/// pixel that is explained. Draws into the current window.
void mixerPanel(EditorState& state);

} // namespace limn
