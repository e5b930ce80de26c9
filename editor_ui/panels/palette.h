// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace limn {

struct EditorState;

/// The palette of all actions: a filter and the actions that match it. Also the sheet of their
/// keys.
struct Palette {
    bool open = false; ///< asks palettePopup() to open it; cleared there
    std::string filter;
    int chosen = 0;         ///< row of the list that Enter runs
    bool helpAsked = false; ///< asks helpSheet() to open its sheet; cleared there
    std::string assigning;  ///< id of the action that the next key is given to; empty: none
};

/// Draws the palette while it is open. Up and Down choose an action, Enter or a click runs it.
void palettePopup(EditorState& state);

} // namespace limn
