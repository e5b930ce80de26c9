// SPDX-License-Identifier: MIT
#include "editor_ui/document/edit_history.h"

#include <algorithm>
#include <utility>

namespace limn {

static void assign(Document& document, ObjectId id, const std::optional<Object>& value) {
    if (value)
        document.objects[id] = *value;
    else
        document.objects.erase(id);
}

static void assignAfter(Document& document, const Edit& edit) {
    for (const Change& change : edit.changes) {
        assign(document, change.id, change.after);
        if (!change.before)
            document.nextId = std::max(document.nextId, change.id + 1);
    }
}

void record(EditHistory& history, Edit edit) {
    history.edits.resize(history.applied);
    history.edits.push_back(std::move(edit));
    ++history.applied;
}

void apply(EditHistory& history, Document& document, Edit edit) {
    if (edit.changes.empty())
        return;
    assignAfter(document, edit);
    record(history, std::move(edit));
}

bool undo(EditHistory& history, Document& document) {
    if (history.applied == 0)
        return false;
    for (const Change& change : history.edits[--history.applied].changes) {
        assign(document, change.id, change.before);
        if (!change.before)
            document.nextId = std::min(document.nextId, change.id);
    }
    return true;
}

bool redo(EditHistory& history, Document& document) {
    if (history.applied == history.edits.size())
        return false;
    assignAfter(document, history.edits[history.applied++]);
    return true;
}

} // namespace limn
