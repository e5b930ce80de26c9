// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/editor_state.h"

namespace limn {

/// The nearest surface under a pixel of the window, in the scene that state.trace was built from; a
/// miss if there is no scene to trace yet.
Hit hitUnder(const EditorState& state, glm::vec2 pixel);

/// The nearest surface under the mouse; std::nullopt if there is none.
std::optional<PickedSurface> surfaceAt(const EditorState& state, glm::vec2 mouse);

/// Selects the light whose icon is within 12 px of the mouse, else the node of the nearest surface,
/// whose mesh becomes ViewState::picked. `extend` adds or removes it instead of replacing the
/// selection.
void pick(EditorState& state, glm::vec2 mouse, bool extend);

} // namespace limn
