// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/panels/keys.h"

namespace limn {

/// Begins a modal question of a fixed width in the middle of the window, opening it where it is not
/// open yet. If it returns true, call ImGui::EndPopup() after its contents.
bool beginDialog(const char* title);

/// The next button of a dialog, beside the one before. Returns true if it or its key was pressed.
bool dialogButton(const char* label, int pressedKey = key::kNone);

} // namespace limn
