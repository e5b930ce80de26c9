// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace limn {

/// Keys that the editor knows. The numbers are GLFW's, so a window passes its codes through.
namespace key {
inline constexpr int kSpace = 32, kSlash = 47, k0 = 48, kA = 65, kNone = 0;
inline constexpr int kEscape = 256, kEnter = 257, kTab = 258, kBackspace = 259, kInsert = 260,
                     kDelete = 261;
inline constexpr int kRight = 262, kLeft = 263, kDown = 264, kUp = 265, kPageUp = 266,
                     kPageDown = 267;
inline constexpr int kHome = 268, kEnd = 269, kF1 = 290, kF2 = 291, kF5 = 294, kF12 = 301;
inline constexpr int kPad0 = 320, kPad1 = 321, kPad3 = 323, kPad7 = 327, kPadDecimal = 330,
                     kPadEnter = 335;
inline constexpr int kLeftShift = 340, kLeftControl = 341, kLeftAlt = 342, kLeftSuper = 343;
inline constexpr int kRightShift = 344, kRightControl = 345, kRightAlt = 346, kRightSuper = 347;
/// Key code of 'A'..'Z' or '0'..'9'.
constexpr int of(char upper) {
    return upper;
}
} // namespace key

enum Mods : std::uint8_t { kNoMods = 0, kCtrl = 1, kShift = 2, kAlt = 4 };

/// A key with exactly these modifiers held.
struct Shortcut {
    int key = key::kNone;
    std::uint8_t mods = kNoMods;

    bool operator==(const Shortcut&) const = default;
};

/// "Ctrl-Shift-Z", "Numpad 1"; empty for no key, and for a key that has no name here.
std::string shortcutText(const Shortcut& shortcut);

/// The shortcut with this text, as shortcutText() writes it: kNone for an empty text, nothing if
/// there is no such shortcut.
std::optional<Shortcut> shortcutFromText(std::string_view text);

} // namespace limn
