// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/document/gesture.h"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace limn {

/// One object being edited by the widgets of a section. Must be created before the first of them.
struct FieldEdit {
    EditorState& state;
    ObjectId id;
    Object seen;
    std::vector<ObjectId> others = {}; ///< of the same type, which get the same edits

    FieldEdit(EditorState& editor, ObjectId object);

    /// The document's objects.
    const ObjectsById& objects() const;
};

/// The label on the left of a row, with a tooltip; the next widget fills the rest of the row.
/// Labels carry units: "Strength (cd)".
void fieldLabel(const char* label, const char* tooltip);

/// Marks the row that fieldLabel() draws next, left of it: the selected objects differ there.
void markMixed();

/// Objects of type T that the edit goes to differ in `get`, a member of T or a function of one.
template <class T, class Get>
bool isMixed(const FieldEdit& edit, const Get& get) {
    const T& shown = std::get<T>(edit.objects().at(edit.id));
    return std::ranges::any_of(edit.others, [&](ObjectId id) {
        const T* other = std::get_if<T>(&edit.objects().at(id));
        return other && std::invoke(get, *other) != std::invoke(get, shown);
    });
}

/// fieldLabel() with a mark where the selected objects differ in `get`.
template <class T, class Get>
void fieldLabel(const FieldEdit& edit, const char* label, const char* tooltip, const Get& get) {
    if (isMixed<T>(edit, get))
        markMixed();
    fieldLabel(label, tooltip);
}

/// The row's widget for a world position, shown and typed in the file's coordinates [m]: three
/// numbers to drag.
void positionField(const char* id, glm::vec3& position, const glm::dvec3& origin);

/// The same for a node's translation [m].
void positionField(const char* id, glm::dvec3& translation);

/// Call after the row's widget. Values that the object's rules forbid are undone; others become
/// part of the gesture.
void fieldEdited(FieldEdit& edit, const char* label);

/// `text`, or as much of its beginning as fits `width` [px], followed by dots.
std::string elided(const std::string& text, float width);

/// Draws text cut to `width` pixels with an ellipsis. If it was cut, a tooltip shows all of it.
void elidedText(const std::string& text, float width);

/// Shows `text` as a wrapped tooltip while the last item is hovered.
void wrappedTooltip(const char* text);

/// "12 345 678"
std::string groupedNumber(unsigned long long n);

/// "512 B", "1.5 MiB"
std::string byteText(unsigned long long bytes);

/// "0.42 ms", "1.3 s", "2 min 05 s"
std::string durationText(double seconds);

} // namespace limn
