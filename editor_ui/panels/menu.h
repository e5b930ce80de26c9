// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace limn {

struct EditorState;

/// Menus that list actions, in the order of the menu bar; submenus follow the menu that they are
/// in.
enum class Menu : std::uint8_t {
    File,
    Edit,
    Transform,
    Visibility,
    Hierarchy,
    Add,
    View,
    Picture,
    Overlay,
    Compare,
    Camera,
    Tool,
    Gizmo,
    Workspace,
    Bake,
    Help
};

struct MenuPlace {
    Menu menu;
    const char* label;
    std::optional<Menu> parent; ///< none: it is in the menu bar
};

/// Every menu, in the order of Menu.
std::span<const MenuPlace> menuPlaces();

/// The menu of the menu bar in which the menu is, or the menu itself.
Menu topMenu(Menu menu);

/// The menus of the menu bar. Draws into the current menu bar.
void menus(EditorState& state);

} // namespace limn
