// SPDX-License-Identifier: MIT
#include "editor_ui/panels/keys.h"

namespace limn {

static std::string keyText(int k) {
    if (k >= key::kF1 && k <= key::kF12)
        return "F" + std::to_string(k - key::kF1 + 1);
    if (k >= key::kPad0 && k <= key::kPad0 + 9)
        return "Numpad " + std::to_string(k - key::kPad0);
    if (k == key::kPadDecimal)
        return "Numpad .";
    if (k == key::kDelete)
        return "Del";
    if (k == key::kEscape)
        return "Esc";
    if (k == key::kEnter)
        return "Enter";
    if (k == key::kPadEnter)
        return "Numpad Enter";
    if (k == key::kEnd)
        return "End";
    if (k == key::kSpace)
        return "Space";
    return std::string(1, char(k));
}

std::string shortcutText(const Shortcut& shortcut) {
    if (shortcut.key == key::kNone)
        return {};
    std::string text;
    if (shortcut.mods & kCtrl)
        text += "Ctrl-";
    if (shortcut.mods & kShift)
        text += "Shift-";
    if (shortcut.mods & kAlt)
        text += "Alt-";
    return text + keyText(shortcut.key);
}

} // namespace limn
