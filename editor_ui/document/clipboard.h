// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/document/gesture.h"

#include <cstdint>

namespace limn {

struct EditorState;

/// Objects that were copied. Kept while other documents are opened.
struct Clipboard {
    ObjectsById objects;         ///< with everything below them
    std::uint64_t sceneHash = 0; ///< of the document they are from
    glm::dvec3 origin{0};        ///< Document::origin of that document
};

/// Copies the selected nodes (with everything below them), lights and cameras.
void copySelection(EditorState& state);

/// The same, and deletes them in one undo step.
void cutSelection(EditorState& state);

/// Whether pasteClipboard() would add anything.
bool canPaste(const EditorState& state);

/// Adds what was copied, where it was, and selects it, in one undo step. Into another scene go
/// lights and cameras alone, because nodes name the meshes of their own scene.
void pasteClipboard(EditorState& state);

} // namespace limn
