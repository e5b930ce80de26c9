// SPDX-License-Identifier: MIT
#include "editor_ui/panels/keys.h"

#include <utility>

namespace limn {

namespace {

constexpr std::pair<int, const char*> kNamedKeys[] = {{key::kSpace, "Space"},
                                                      {key::kEscape, "Esc"},
                                                      {key::kEnter, "Enter"},
                                                      {key::kTab, "Tab"},
                                                      {key::kInsert, "Insert"},
                                                      {key::kBackspace, "Backspace"},
                                                      {key::kDelete, "Del"},
                                                      {key::kRight, "Right"},
                                                      {key::kLeft, "Left"},
                                                      {key::kDown, "Down"},
                                                      {key::kUp, "Up"},
                                                      {key::kPageUp, "Page Up"},
                                                      {key::kPageDown, "Page Down"},
                                                      {key::kHome, "Home"},
                                                      {key::kEnd, "End"},
                                                      {key::kPadDecimal, "Numpad ."},
                                                      {key::kPadEnter, "Numpad Enter"}};

constexpr std::pair<Mods, const char*> kModNames[] = {
    {kCtrl, "Ctrl-"}, {kShift, "Shift-"}, {kAlt, "Alt-"}};

constexpr int kLastKey = 348; // of GLFW

} // namespace

static std::string keyText(int k) {
    for (const auto& [named, name] : kNamedKeys)
        if (k == named)
            return name;
    if (k >= key::kF1 && k <= key::kF12)
        return "F" + std::to_string(k - key::kF1 + 1);
    if (k >= key::kPad0 && k <= key::kPad0 + 9)
        return "Numpad " + std::to_string(k - key::kPad0);
    return k > ' ' && k <= '`' ? std::string(1, char(k)) : std::string();
}

std::string shortcutText(const Shortcut& shortcut) {
    const std::string name = keyText(shortcut.key);
    if (name.empty())
        return {};
    std::string text;
    for (const auto& [mod, modName] : kModNames)
        if (shortcut.mods & mod)
            text += modName;
    return text + name;
}

std::optional<Shortcut> shortcutFromText(std::string_view text) {
    if (text.empty())
        return Shortcut{};
    Shortcut shortcut;
    for (const auto& [mod, name] : kModNames)
        if (text.starts_with(name)) {
            shortcut.mods |= mod;
            text.remove_prefix(std::string_view(name).size());
        }
    for (int k = 1; k <= kLastKey; ++k)
        if (const std::string name = keyText(k); !name.empty() && name == text) {
            shortcut.key = k;
            return shortcut;
        }
    return {};
}

} // namespace limn
