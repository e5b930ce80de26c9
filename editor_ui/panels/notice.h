// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace limn {

struct EditorState;

/// Something that went wrong with what the user asked for.
struct Notice {
    std::string title; ///< what could not be done
    std::string text;  ///< the file and the reason
};

/// Draws state.notice over the top of the picture, until the user dismisses it.
void noticeBox(EditorState& state);

} // namespace limn
