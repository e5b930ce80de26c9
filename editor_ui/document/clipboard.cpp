// SPDX-License-Identifier: MIT
#include "editor_ui/document/clipboard.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/editor_state.h"
#include "engine/scene/find_object.h"

#include <algorithm>
#include <utility>

namespace limn {

void copySelection(EditorState& state) {
    commitGesture(state);
    Clipboard copied{.sceneHash = state.document.sceneHash, .origin = state.document.origin};
    for (ObjectId id : selectionWithChildren(state))
        copied.objects.emplace(id, state.document.objects.at(id));
    if (!copied.objects.empty())
        state.clipboard = std::move(copied);
}

void cutSelection(EditorState& state) {
    copySelection(state);
    deleteSelection(state);
}

static bool fits(const EditorState& state, const Object& object) {
    return !std::holds_alternative<Node>(object) ||
           state.clipboard.sceneHash == state.document.sceneHash;
}

bool canPaste(const EditorState& state) {
    return std::ranges::any_of(state.clipboard.objects,
                               [&](const auto& entry) { return fits(state, entry.second); });
}

/// Moves a light or camera whose coordinates are relative to the origin of another document.
static void shift(Object& object, glm::vec3 offset) {
    if (auto* light = std::get_if<Light>(&object))
        light->position += offset;
    if (auto* camera = std::get_if<Camera>(&object)) {
        camera->eye += offset;
        camera->target += offset;
    }
}

void pasteClipboard(EditorState& state) {
    commitGesture(state);
    ObjectsById pasted;
    const glm::vec3 offset(state.clipboard.origin - state.document.origin);
    for (const auto& [id, object] : state.clipboard.objects)
        if (fits(state, object))
            shift(pasted.emplace(id, object).first->second, offset);
    Copies copies = copiesOf(state.document, pasted);
    const std::size_t count = copies.objects.size();
    Edit edit{count == 1 ? "Paste " + objectName(copies.objects.begin()->second)
                         : "Paste " + std::to_string(count) + " objects",
              {}};
    for (auto& [id, copy] : copies.objects) {
        auto* node = std::get_if<Node>(&copy);
        if (node && !copies.objects.contains(node->parent) &&
            !findObjectAs<Node>(state.document, node->parent))
            node->parent = 0; // it has been deleted since
        edit.changes.push_back({id, {}, copy});
    }
    if (edit.changes.empty())
        return;
    applyEdit(state, std::move(edit));
    state.selection = std::move(copies.tops);
}

} // namespace limn
