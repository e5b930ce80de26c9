// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/editor_state.h"

namespace limn {

/// What lies under the mouse: a light's icon within 12 px first, then the nearest surface's node.
/// 0: nothing.
ObjectId objectAt(const EditorState& state, glm::vec2 mouse);

/// Selects what lies under the mouse. `extend` adds or takes it away instead of replacing the
/// selection.
void pick(EditorState& state, glm::vec2 mouse, bool extend);

} // namespace limn
