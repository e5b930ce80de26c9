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
        if (before != after.at(id))
            edit.changes.push_back({id, before, after.at(id)});
    if (!edit.changes.empty())
        record(state.history, std::move(edit));
}

static bool sameObjects(const ObjectsById& a, const ObjectsById& b) {
    return std::ranges::equal(a, b, {}, &ObjectsById::value_type::first,
                              &ObjectsById::value_type::first);
}

void trackEdits(EditorState& state, ObjectsById& seen, const char* label) {
    const bool changed = std::ranges::any_of(seen, [&](const auto& entry) {
        return state.document.objects.at(entry.first) != entry.second;
    });
    if (!changed)
        return;
    // The user went straight to another widget or object (Tab, viewport pick).
    if (state.gesture && !sameObjects(state.gesture->before, seen))
        commitGesture(state);
    else if (state.gesture && state.gesture->label != label)
        commit(state, seen);

    if (!state.gesture)
        state.gesture = Gesture{seen, label};
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

void commitGesture(EditorState& state) {
    if (!state.gesture)
        return;
    ObjectsById now;
    for (const auto& [id, before] : state.gesture->before)
        now.emplace(id, state.document.objects.at(id));
    commit(state, now);
}

void cancelGesture(EditorState& state) {
    if (!state.gesture)
        return;
    for (const auto& [id, before] : state.gesture->before)
        state.document.objects.at(id) = before;
    state.gesture.reset();
}

} // namespace limn
