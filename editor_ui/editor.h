// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/panels/keys.h"

#include <span>

namespace limn {

struct EditorState;

/// Draws one frame of the whole interface, between ImGui::NewFrame() and ImGui::Render():
/// shortcuts, menu, panels, dialogs. `pressed` holds the keys that went down, from feedInput().
/// Ends the gesture when nothing is held any more. Work to be done outside the interface is left in
/// state.requests.
void drawEditor(EditorState& state, std::span<const Shortcut> pressed);

} // namespace limn
