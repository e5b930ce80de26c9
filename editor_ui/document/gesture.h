// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/document/edit_history.h"

#include <map>
#include <string>

namespace limn {

struct EditorState;

using ObjectsById = std::map<ObjectId, Object>;

/// A drag, a text entry, a gizmo move: many small edits of the same objects, one undo step.
/// The document already has the new values; the history gets them when the gesture ends.
struct Gesture {
    ObjectsById before;
    std::string label;
    bool creates = false; ///< the objects are new; `before` is how they were made
};

/// Call after each widget that edits object `id`. `seen` starts as a copy of the object made before
/// the first widget, and is brought up to date here. Values are compared because ImGui's status
/// flags miss some edits: a slider jumps on the frame of the click, and typing into a ColorEdit
/// field can be applied without IsItemEdited().
void trackEdit(EditorState& state, ObjectId id, Object& seen, const char* label);

/// The same for several objects moved together (the gizmo).
void trackEdits(EditorState& state, ObjectsById& seen, const char* label);

/// Begins a gesture that puts new objects into the document, under ids from Document::nextId on.
/// What trackEdit() says of them under the same label belongs to it.
void beginCreation(EditorState& state, ObjectsById objects, const char* label);

/// Ends the gesture, if any. Call when nothing is held any more (after all panels, each frame)
/// and before undo, redo, save and every other action.
void commitGesture(EditorState& state);

/// Ends the gesture, if any, as though it had never begun.
void cancelGesture(EditorState& state);

} // namespace limn
