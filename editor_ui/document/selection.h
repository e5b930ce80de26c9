// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <optional>
#include <unordered_set>
#include <vector>

namespace limn {

struct EditorState;

/// Where the gizmo of a selection stands.
enum class GizmoPlace {
    Middle,  ///< of the selection's bounding box
    Origins, ///< mean of the objects' own origins
    Click    ///< the surface that was clicked last
};

/// A surface of a node that was clicked: one of its meshes.
struct PickedSurface {
    ObjectId node = 0;
    std::uint32_t mesh = 0; ///< index into Assets::meshes
    glm::vec3 position{0};  ///< of the click, in world space [m]
};

/// Whether `id` or one of its ancestors is in `ids`.
bool inOrBelow(const Document& document, ObjectId id, const std::unordered_set<ObjectId>& ids);

/// Drops ids from the selection that the document no longer has.
void pruneSelection(EditorState& state);

/// Those of `tops` that can be deleted, and the nodes below them, in the order of their ids.
std::vector<ObjectId> withChildren(const Document& document,
                                   const std::unordered_set<ObjectId>& tops);

/// The selected objects that can be deleted, and the nodes below them, parents before children.
std::vector<ObjectId> selectionWithChildren(const EditorState& state);

/// The selected objects the gizmo moves: a node whose ancestor is selected moves with it and is
/// left out.
std::map<ObjectId, Object> movableSelection(const EditorState& state);

/// World-space position of the gizmo, by ViewState::gizmoPlace; std::nullopt if there is nothing to
/// move. Click falls back to Middle while no surface of the active object was clicked.
std::optional<glm::vec3> selectionOrigin(const EditorState& state);

/// World-space bounding box of the selection, or of the scene if nothing with a position is
/// selected. A light counts as a point.
Bounds selectionBounds(const EditorState& state);

/// World-space bounding box of one object and the nodes below it; a point for lights and cameras,
/// std::nullopt for what has no place.
std::optional<Bounds> boundsOf(const EditorState& state, ObjectId id);

/// The surface that was clicked last, if it belongs to the active object; else null.
const PickedSurface* pickedSurface(const EditorState& state);

} // namespace limn
