// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/panels/keys.h"

#include <map>
#include <string>
#include <vector>

namespace limn {

struct Action;
struct EditorState;

/// Keys that the user has assigned to actions, by action id; kNone: the action has no key.
using KeyMap = std::map<std::string, Shortcut>;

/// The keys that run an action: those of the table, or the one that the user has chosen. May be
/// empty.
std::vector<Shortcut> shortcutsOf(const EditorState& state, const Action& action);

/// Whether an action can be given this key: it has a name, and neither closes what is open nor
/// edits a text.
bool isAssignable(const Shortcut& shortcut);

/// Makes an action run by this key alone, or by none where it is kNone. Another action that had the
/// key keeps only its other one. Precondition: kNone, or isAssignable().
void assignKey(EditorState& state, const Action& action, const Shortcut& shortcut);

} // namespace limn
