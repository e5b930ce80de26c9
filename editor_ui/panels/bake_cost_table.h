// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// What a bake with the document's settings is expected to take, and beside it what the last one
/// took: seconds in all and stage by stage, memory, time to relight. Draws into the current window.
void bakeCostTable(const EditorState& state);

} // namespace limn
