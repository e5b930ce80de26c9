// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// Asks whether to save the document while state.confirm waits for it to be left: save, which goes
/// on with the request once the file is written; don't save, which goes on at once; or cancel.
void saveDialog(EditorState& state);

} // namespace limn
