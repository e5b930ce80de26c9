// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// What to open, over the empty picture, while nothing is open: recent documents, samples, a file.
/// Draws its own window.
void startScreen(EditorState& state);

} // namespace limn
