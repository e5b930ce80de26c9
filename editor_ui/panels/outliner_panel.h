// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// The tree of nodes, then lights, materials, cameras, sky and bake settings, with a filter box.
/// Draws into the current window.
void outlinerPanel(EditorState& state);

} // namespace limn
