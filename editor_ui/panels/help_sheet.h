// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// All keys and what the mouse does, in a popup, which opens when Palette::helpAsked is set.
/// Call once per frame.
void helpSheet(EditorState& state);

} // namespace limn
