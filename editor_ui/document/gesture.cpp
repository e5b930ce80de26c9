// SPDX-License-Identifier: MIT
#include "editor_ui/document/gesture.h"

#include "editor_ui/editor_state.h"

#include <algorithm>
#include <utility>

namespace limn {

static void commit(EditorState& state, const ObjectsById& after) {
    Gesture gesture = std::move(*state.gesture);
    state.gesture.reset();
    Edit edit{std::move(gesture.label), {}};
    for (const auto& [id, before] : gesture.before)
        if (gesture.creates)
            edit.changes.push_back({id, {}, after.at(id)});
        else if (before != after.at(id))
            edit.changes.push_back({id, before, after.at(id)});
    if (!edit.changes.empty())
        record(state.history, std::move(edit));
}

/// The gesture's objects as they are, but for those in `seen`.
static ObjectsById objectsNow(const EditorState& state, const ObjectsById& seen) {
    ObjectsById now;
    for (const auto& [id, before] : state.gesture->before) {
        const auto found = seen.find(id);
        now.emplace(id, found == seen.end() ? state.document.objects.at(id) : found->second);
    }
    return now;
}

/// Whether edits of these objects under this label are part of the gesture.
static bool belongsTo(const Gesture& gesture, const ObjectsById& objects, const char* label) {
    const auto known = [&](const auto& entry) { return gesture.before.contains(entry.first); };
    return gesture.label == label && std::ranges::all_of(objects, known) &&
           (gesture.creates || objects.size() == gesture.before.size());
}

void trackEdits(EditorState& state, ObjectsById& seen, const char* label) {
    const bool changed = std::ranges::any_of(seen, [&](const auto& entry) {
        return state.document.objects.at(entry.first) != entry.second;
    });
    if (!changed)
        return;
    // The user went straight to another widget or object (Tab, viewport pick).
    if (state.gesture && !belongsTo(*state.gesture, seen, label))
        commit(state, objectsNow(state, seen));
    if (!state.gesture)
        state.gesture = Gesture{.before = seen, .label = label};
    for (auto& [id, object] : seen)
        object = state.document.objects.at(id);
}

void trackEdit(EditorState& state, ObjectId id, Object& seen, const char* label) {
    if (state.document.objects.at(id) == seen)
        return;
    ObjectsById one{{id, std::move(seen)}};
    trackEdits(state, one, label);
    seen = std::move(one.at(id));
}

void beginCreation(EditorState& state, ObjectsById objects, const char* label) {
    commitGesture(state);
    for (const auto& [id, object] : objects) {
        state.document.objects.emplace(id, object);
        state.document.nextId = std::max(state.document.nextId, id + 1);
    }
    if (!objects.empty())
        state.gesture = Gesture{.before = std::move(objects), .label = label, .creates = true};
}

void commitGesture(EditorState& state) {
    if (!state.gesture)
        return;
    commit(state, objectsNow(state, {}));
}

void cancelGesture(EditorState& state) {
    if (!state.gesture)
        return;
    Document& document = state.document;
    for (const auto& [id, before] : state.gesture->before)
        if (state.gesture->creates) {
            document.objects.erase(id);
            document.nextId = std::min(document.nextId, id);
        } else {
            document.objects.at(id) = before;
        }
    state.gesture.reset();
}

} // namespace limn
