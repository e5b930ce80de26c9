// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace limn {

/// One object before and after an edit. Without `before` it was created; without `after` it was
/// deleted.
struct Change {
    ObjectId id = 0;
    std::optional<Object> before, after;
};

/// One entry of the Edit menu: everything one user gesture did.
struct Edit {
    std::string label;
    std::vector<Change> changes;
};

/// edits[0, applied) are in the document; the rest can be redone.
struct EditHistory {
    std::vector<Edit> edits;
    std::size_t applied = 0;
};

/// Records an edit that is already in the document. Drops what could be redone.
void record(EditHistory& history, Edit edit);

/// Puts every change's `after` into the document and records the edit. An edit without changes is
/// ignored.
void apply(EditHistory& history, Document& document, Edit edit);

/// Returns false when there is nothing to undo (redo). Undoing a creation gives its id back to
/// Document::nextId, so undoing everything restores the document to the last bit.
bool undo(EditHistory& history, Document& document);
bool redo(EditHistory& history, Document& document);

} // namespace limn
