// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/editor_state.h"

namespace limn {

/// The list of what makes the light of the scene go wrong, with the button that checks it. Draws
/// into the current window. A click on a row selects its object.
void lintPanel(EditorState& state);

} // namespace limn
