// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

#include <vector>

namespace limn {

struct EditorState;

/// Each of these functions is one undo step that keeps every object where it is in the world. A
/// transform has no shear: where parents are scaled unevenly, an object's place stays exact and its
/// rotation and scale come as near as they can. Where a function does not apply, it changes and
/// records nothing.

/// Puts the selected nodes below a new node "Group" and selects it. It stands below the parent that
/// they all have, else at the root.
void groupSelection(EditorState& state);

/// Whether ungroupSelection() would change anything.
bool canUngroup(const EditorState& state);

/// Deletes the selected nodes that are groups, which have nodes below them and no mesh, and leaves
/// and selects the nodes below. These stay hidden or dynamic if their group was.
void ungroupSelection(EditorState& state);

/// Puts nodes below another node; 0: at the root. Nodes that would come below themselves are left
/// alone.
void reparent(EditorState& state, const std::vector<ObjectId>& nodes, ObjectId parent);

} // namespace limn
