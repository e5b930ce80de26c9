// SPDX-License-Identifier: MIT
#pragma once

#include <ctime>
#include <string>

namespace limn {

struct EditorState;

/// A copy of unsaved changes that an editor left behind when it ended.
struct RecoveryOffer {
    std::string originalPath; ///< path of the project, or of the scene that was never saved as one
    std::time_t written = 0;  ///< when the copy was written
};

/// Asks what to do with the copy while state.recovery is set: recover it, discard it, or neither.
void recoveryDialog(EditorState& state);

} // namespace limn
