// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/panels/keys.h"
#include "editor_ui/panels/menu.h"

#include <functional>
#include <span>
#include <string>

namespace limn {

struct EditorState;
struct OverlayKind;

/// One thing the user can do. Menus, shortcuts and the palette read the same table.
struct Action {
    std::string id;    ///< "edit.undo"
    const char* label; ///< "Undo"
    Menu menu;
    Shortcut shortcut;
    Shortcut alternative; ///< a second key for the same thing
    bool separator;       ///< a line above it; of the first of a submenu: above the submenu
    bool (*enabled)(const EditorState&);
    std::function<void(EditorState&)> run;
    std::function<bool(const EditorState&)> checked = {}; ///< of a toggle or a choice; else empty
};

std::span<const Action> actions();

/// The action with this id; asserts that there is one.
const Action& actionById(const char* id);

/// The action that shows an overlay; null: none.
const Action& overlayAction(const OverlayKind* kind);

/// Ends the gesture, then runs the action if it is enabled.
void runAction(EditorState& state, const Action& action);

/// Label of an action with what it would act on, such as "Undo Move Key light".
std::string actionLabel(const EditorState& state, const Action& action);

/// The key that runs an action, with the keys that the user has chosen; kNone if there is none.
Shortcut shortcutOf(const EditorState& state, const Action& action);

/// Runs the action whose shortcut this is. Returns false if there is none.
bool runShortcut(EditorState& state, const Shortcut& pressed);

} // namespace limn
