// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/editor_state.h"

namespace limn {

/// The object under the mouse: a light's icon within 12 px, else the nearest surface's node; 0 if
/// there is none.
ObjectId objectAt(const EditorState& state, glm::vec2 mouse);

/// Selects the object under the mouse. `extend` adds or removes it instead of replacing the
/// selection.
void pick(EditorState& state, glm::vec2 mouse, bool extend);

} // namespace limn
