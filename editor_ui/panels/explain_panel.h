// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/editor_state.h"

namespace limn {

/// The table that says where the light of a pixel comes from. Draws into the current window. Rows
/// under the mouse set ExplainState::hovered; a click on a row selects its object.
void explainPanel(EditorState& state);

/// Chooses the pixel under the mouse; keeps the old one if it shows no surface.
void explainAt(EditorState& state, glm::vec2 mouse);

} // namespace limn
