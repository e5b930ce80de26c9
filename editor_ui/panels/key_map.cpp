// SPDX-License-Identifier: MIT
#include "editor_ui/panels/key_map.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace limn {

/// The key of the table, with the habit of Blender's users where that is chosen.
static Shortcut usualKey(const EditorState& state, const Action& action) {
    if (state.view.gizmo.blenderKeys && action.id == "tool.scale")
        return {};
    if (state.view.gizmo.blenderKeys && action.id == "grab.rotate")
        return {key::of('R'), kNoMods};
    return action.shortcut;
}

std::vector<Shortcut> shortcutsOf(const EditorState& state, const Action& action) {
    std::vector<Shortcut> keys;
    if (const auto chosen = state.keys.find(action.id); chosen != state.keys.end())
        keys = {chosen->second};
    else
        keys = {usualKey(state, action), action.alternative};
    std::erase_if(keys, [](const Shortcut& s) { return s.key == key::kNone; });
    return keys;
}

bool isAssignable(const Shortcut& shortcut) {
    constexpr std::array kOfWindows = {key::kEscape, key::kEnter, key::kPadEnter, key::kTab,
                                       key::kBackspace};
    return !shortcutText(shortcut).empty() &&
           std::ranges::find(kOfWindows, shortcut.key) == kOfWindows.end();
}

void assignKey(EditorState& state, const Action& action, const Shortcut& shortcut) {
    assert(shortcut.key == key::kNone || isAssignable(shortcut));
    for (const Action& other : actions()) {
        std::vector<Shortcut> keys = shortcutsOf(state, other);
        if (&other != &action && std::erase(keys, shortcut) > 0)
            state.keys[other.id] = keys.empty() ? Shortcut{} : keys.front();
    }
    state.keys[action.id] = shortcut;
}

} // namespace limn
